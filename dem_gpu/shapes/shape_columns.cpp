// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/shape_columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem_gpu {
namespace {

using catalog::ConvexFace;
using catalog::ConvexPart;
using catalog::FaceKind;

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

HalfSpace to_half_space(const ConvexFace& face) { return {to_vec3(face.plane.normal), face.plane.offset}; }

bool is_same_plane(const HalfSpace& a, const HalfSpace& b, Real size) {
  return norm(a.normal - b.normal) < 1e-9 && std::abs(a.offset - b.offset) < 1e-9 * size;
}

bool lies_behind(const ConvexPart& part, const HalfSpace& plane, Real size) {
  return std::all_of(part.vertices.begin(), part.vertices.end(), [&](const catalog::Point& vertex) {
    return dot(plane.normal, to_vec3(vertex)) <= plane.offset + 1e-9 * size;
  });
}

/// Terms of the depth field in one part: its own outer planes and every outer plane of the body that the part lies
/// wholly behind, unless that is the plane of one of the part's own cut faces. Exact distance to the surface for a
/// convex body whatever its cut.
std::vector<HalfSpace> depth_planes(const std::vector<ConvexPart>& parts, std::size_t self, Real size) {
  std::vector<HalfSpace> planes, own_cuts;
  const auto add_new = [&](const HalfSpace& plane) {
    for (const HalfSpace& known : planes)
      if (is_same_plane(known, plane, size)) return;
    planes.push_back(plane);
  };
  for (const ConvexFace& face : parts[self].faces) {
    if (face.kind == FaceKind::outer)
      add_new(to_half_space(face));
    else
      own_cuts.push_back(to_half_space(face));
  }
  for (std::size_t other = 0; other < parts.size(); ++other) {
    if (other == self) continue;
    for (const ConvexFace& face : parts[other].faces) {
      if (face.kind != FaceKind::outer) continue;
      const HalfSpace plane = to_half_space(face);
      const bool is_own_cut = std::any_of(own_cuts.begin(), own_cuts.end(),
                                          [&](const HalfSpace& cut) { return is_same_plane(cut, plane, size); });
      if (!is_own_cut && lies_behind(parts[self], plane, size)) add_new(plane);
    }
  }
  return planes;
}

PartRange append_part(HostShapeColumns& columns, const ConvexPart& part) {
  PartRange range;
  range.first_vertex = static_cast<int>(columns.vertices.size());
  range.vertex_count = static_cast<int>(part.vertices.size());
  range.first_face = static_cast<int>(columns.planes.size());
  range.face_count = static_cast<int>(part.faces.size());
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const catalog::Point& point : part.vertices) {
    const Vec3 vertex = to_vec3(point);
    columns.vertices.push_back(vertex);
    low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y), std::min(low.z, vertex.z)};
    high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y), std::max(high.z, vertex.z)};
  }
  range.centre = Real(0.5) * (low + high);
  for (const catalog::Point& point : part.vertices)
    range.radius = std::max(range.radius, norm(to_vec3(point) - range.centre));
  for (const FaceKind kind : {FaceKind::outer, FaceKind::inner})
    for (const ConvexFace& face : part.faces) {
      if (face.kind != kind) continue;
      columns.planes.push_back(to_half_space(face));
      FaceCorners corners{static_cast<int>(columns.corners.size()), static_cast<int>(face.vertices.size())};
      for (const int vertex : face.vertices) {
        columns.corners.push_back(static_cast<std::uint8_t>(vertex));
        corners.vertices |= std::uint64_t{1} << vertex;
      }
      columns.faces.push_back(corners);
      if (kind == FaceKind::outer) ++range.outer_face_count;
    }
  return range;
}

void append_polyhedron(HostShapeColumns& columns, const PolyhedralShape& polyhedron, ShapeRange& range,
                       Real depth_cap) {
  range.first_part = static_cast<int>(columns.parts.size());
  range.part_count = static_cast<int>(polyhedron.parts.size());
  for (std::size_t p = 0; p < polyhedron.parts.size(); ++p) {
    PartRange part = append_part(columns, polyhedron.parts[p]);
    part.first_depth_plane = static_cast<int>(columns.depth_planes.size());
    for (const HalfSpace& plane : depth_planes(polyhedron.parts, p, range.equivalent_diameter))
      columns.depth_planes.push_back(plane);
    columns.depth_planes.push_back({Vec3{0, 0, 0}, depth_cap * range.equivalent_diameter});
    part.depth_plane_count = static_cast<int>(columns.depth_planes.size()) - part.first_depth_plane;
    columns.parts.push_back(part);
    for (const catalog::Point& vertex : polyhedron.parts[p].vertices)
      range.bounding_radius = std::max(range.bounding_radius, norm(to_vec3(vertex)));
  }
}

}  // namespace

HostShapeColumns make_host_shape_columns(const std::vector<Shape>& shapes, Real depth_cap) {
  HostShapeColumns columns;
  for (const Shape& shape : shapes) {
    ShapeRange range;
    range.volume = shape.volume;
    range.inertia = shape.principal_inertia;
    range.equivalent_diameter = std::cbrt(6 * shape.volume / std::numbers::pi);
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry))
      range.sphere_radius = range.bounding_radius = sphere->radius;
    else
      append_polyhedron(columns, std::get<PolyhedralShape>(shape.geometry), range, depth_cap);
    columns.shapes.push_back(range);
  }
  return columns;
}

ShapeColumns make_shape_columns(const std::vector<Shape>& shapes, Real depth_cap) {
  const HostShapeColumns host = make_host_shape_columns(shapes, depth_cap);
  ShapeColumns columns;
  assign(columns.shapes, host.shapes);
  assign(columns.parts, host.parts);
  assign(columns.vertices, host.vertices);
  assign(columns.planes, host.planes);
  assign(columns.faces, host.faces);
  assign(columns.corners, host.corners);
  assign(columns.depth_planes, host.depth_planes);
  return columns;
}

ShapeView view(const ShapeColumns& columns) {
  return {pointer(columns.shapes), pointer(columns.parts),   pointer(columns.vertices),    pointer(columns.planes),
          pointer(columns.faces),  pointer(columns.corners), pointer(columns.depth_planes)};
}

ShapeView view(const HostShapeColumns& columns) {
  return {columns.shapes.data(), columns.parts.data(),   columns.vertices.data(),    columns.planes.data(),
          columns.faces.data(),  columns.corners.data(), columns.depth_planes.data()};
}

}  // namespace dem_gpu
