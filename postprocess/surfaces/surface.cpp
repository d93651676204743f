// SPDX-License-Identifier: Apache-2.0
#include "postprocess/surfaces/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace postprocess {

using dem_gpu::Vec3;
using dem_gpu::WallGeometry;
using dem_gpu::WallKind;

namespace {

// How far a plane is drawn beyond the scene's box [share of its diagonal].
constexpr double kPlaneRoom = 0.03;

/// Rings of `segments` points about the axis, joined by quadrilaterals; a ring of radius 0 is a point.
Surface surface_of_revolution(const Vec3& base, const Vec3& axis, const std::vector<std::pair<double, double>>& rings,
                              int segments) {
  const Vec3 side = dem_gpu::any_perpendicular(axis), other = dem_gpu::cross(axis, side);
  Surface surface;
  for (const auto& [height, radius] : rings)
    for (int s = 0; s < segments; ++s) {
      const double angle = 2 * std::numbers::pi * s / segments;
      surface.points.push_back(base + height * axis + radius * (std::cos(angle) * side + std::sin(angle) * other));
    }
  for (int r = 0; r + 1 < static_cast<int>(rings.size()); ++r)
    for (int s = 0; s < segments; ++s) {
      const int next = (s + 1) % segments, low = r * segments, high = low + segments;
      surface.add_polygon({low + s, low + next, high + next, high + s});
    }
  return surface;
}

Surface disc_surface(const WallGeometry& wall, int segments) {
  Surface surface = surface_of_revolution(wall.point, wall.direction, {{0.0, wall.base_radius}}, segments);
  std::vector<int> rim;
  for (int s = 0; s < segments; ++s) rim.push_back(s);
  surface.add_polygon(rim);
  return surface;
}

/// The part of a convex polygon where dot(x, normal) <= offset (Sutherland & Hodgman 1974).
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& normal, double offset) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = dot(from, normal) - offset, after = dot(to, normal) - offset;
    if (before <= 0) kept.push_back(from);
    if ((before < 0 && after > 0) || (before > 0 && after < 0))
      kept.push_back(from + before / (before - after) * (to - from));
  }
  return kept;
}

/// The plane within the scene's box, made a little larger; nothing if it passes by the box.
Surface plane_surface(const WallGeometry& wall, const Bounds& bounds) {
  if (bounds.is_empty()) return {};
  const Vec3 centre = bounds.middle() - dot(bounds.middle() - wall.point, wall.direction) * wall.direction;
  const Vec3 side = dem_gpu::any_perpendicular(wall.direction), other = dem_gpu::cross(wall.direction, side);
  std::vector<Vec3> polygon;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    polygon.push_back(centre + 2 * bounds.diagonal() * (u * side + v * other));
  const double room = kPlaneRoom * bounds.diagonal();
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    polygon = clipped(polygon, axis, dot(bounds.high, axis) + room);
    polygon = clipped(polygon, -axis, -dot(bounds.low, axis) + room);
  }
  Surface surface;
  if (polygon.size() < 3) return surface;
  surface.points = polygon;
  std::vector<int> corners;
  for (int c = 0; c < static_cast<int>(polygon.size()); ++c) corners.push_back(c);
  surface.add_polygon(corners);
  return surface;
}

Surface part_surface(const catalog::ConvexPart& part) {
  Surface surface;
  for (const catalog::Point& vertex : part.vertices) surface.points.push_back({vertex[0], vertex[1], vertex[2]});
  for (const catalog::ConvexFace& face : part.faces) surface.add_polygon(face.vertices);
  return surface;
}

}  // namespace

void Surface::add_polygon(const std::vector<int>& indices) {
  corners.insert(corners.end(), indices.begin(), indices.end());
  polygon_end.push_back(static_cast<int>(corners.size()));
}

Surface unit_sphere(int levels) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> points;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Vec3& corner : {Vec3{0, a, b}, Vec3{a, b, 0}, Vec3{b, 0, a}}) points.push_back(corner / norm(corner));
  // Faces of the icosahedron: triples of corners one edge apart.
  const double edge = 2 / std::sqrt(1 + golden * golden);
  const auto are_joined = [&](int i, int j) { return std::abs(norm(points[i] - points[j]) - edge) < 1e-6; };
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k)
        if (are_joined(i, j) && are_joined(j, k) && are_joined(i, k)) {
          const bool is_outward = dot(cross(points[j] - points[i], points[k] - points[i]), points[i]) > 0;
          faces.push_back(is_outward ? std::array{i, j, k} : std::array{i, k, j});
        }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) points.push_back(dem_gpu::unit_or(points[a] + points[b], points[a]));
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  Surface sphere;
  sphere.points = std::move(points);
  for (const auto& face : faces) sphere.add_polygon({face[0], face[1], face[2]});
  return sphere;
}

Surface shape_surface(const dem_gpu::ShapeGeometry& shape, int sphere_levels) {
  Surface surface;
  if (shape.sphere_radius > 0) {
    append(surface, unit_sphere(sphere_levels), {{}, {}, shape.sphere_radius});
    return surface;
  }
  for (const catalog::ConvexPart& part : shape.parts) append(surface, part_surface(part), {});
  return surface;
}

std::pair<int, int> append(Surface& surface, const Surface& part, const Placement& placement) {
  const int first_point = static_cast<int>(surface.points.size()), first_polygon = surface.polygon_count();
  const int first_corner = static_cast<int>(surface.corners.size());
  const dem_gpu::Mat3 rotation = rotation_matrix(placement.rotation);
  for (const Vec3& point : part.points)
    surface.points.push_back(rotation * (placement.scale * point) + placement.translation);
  for (const int corner : part.corners) surface.corners.push_back(first_point + corner);
  for (const int end : part.polygon_end) surface.polygon_end.push_back(first_corner + end);
  return {first_polygon, surface.polygon_count()};
}

/// Subdivisions of an octahedron for a spherical wall.
constexpr int kWallSphereLevels = 5;

void Bounds::include(const Vec3& point) {
  if (is_empty()) low = high = point;
  low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
  high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
}

double bounding_radius(const dem_gpu::ShapeGeometry& shape) {
  double radius = shape.sphere_radius;
  for (const catalog::ConvexPart& part : shape.parts)
    for (const catalog::Point& v : part.vertices) radius = std::max(radius, std::hypot(v[0], v[1], v[2]));
  return radius;
}

Bounds scene_bounds(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot) {
  Bounds bounds;
  std::vector<double> radius;
  for (const dem_gpu::ShapeGeometry& shape : geometry.shapes) radius.push_back(bounding_radius(shape));
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
    if (!snapshot.active[b]) continue;
    const double r = radius[geometry.body_shape[b]] * geometry.body_scale[b];
    bounds.include(snapshot.position[b] - Vec3{r, r, r});
    bounds.include(snapshot.position[b] + Vec3{r, r, r});
  }
  for (std::size_t w = 0; w < geometry.walls.size(); ++w) {
    if (geometry.walls[w].kind == WallKind::plane || !snapshot.wall_present[w]) continue;
    Surface placed;
    append(placed, wall_surface(geometry.walls[w], {}), wall_placement(snapshot, static_cast<int>(w)));
    for (const Vec3& point : placed.points) bounds.include(point);
  }
  return bounds;
}

Surface mesh_surface(const catalog::TriangleMesh& mesh) {
  Surface surface;
  for (const catalog::Point& p : mesh.vertices) surface.points.push_back({p[0], p[1], p[2]});
  for (const catalog::Triangle& face : mesh.faces) surface.add_polygon({face[0], face[1], face[2]});
  return surface;
}

Surface wall_surface(const WallGeometry& wall, const Bounds& bounds, int segments) {
  switch (wall.kind) {
    case WallKind::plane:
      return plane_surface(wall, bounds);
    case WallKind::disc:
      return disc_surface(wall, segments);
    case WallKind::cylinder:
      return surface_of_revolution(wall.point, wall.direction,
                                   {{0.0, wall.base_radius}, {wall.length, wall.base_radius}}, segments);
    case WallKind::cone:
      return surface_of_revolution(wall.point, wall.direction,
                                   {{0.0, wall.base_radius}, {wall.length, wall.top_radius}}, segments);
    case WallKind::volume_object:
      return part_surface(wall.part);
    case WallKind::mesh:
      return mesh_surface(wall.mesh);
    case WallKind::sphere: {
      Surface ball;
      append(ball, unit_sphere(kWallSphereLevels), {{}, wall.point, wall.base_radius});
      return ball;
    }
  }
  return {};
}

Placement wall_placement(const dem_gpu::Snapshot& snapshot, int wall) {
  return {snapshot.wall_rotation[wall], snapshot.wall_translation[wall], 1};
}

Placement body_placement(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot, int body) {
  return {snapshot.orientation[body], snapshot.position[body], geometry.body_scale[body]};
}

}  // namespace postprocess
