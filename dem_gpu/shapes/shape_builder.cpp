// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "dem_gpu/narrow_phase/volume_integrals.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {
namespace {

using catalog::ConvexFace;
using catalog::ConvexPart;
using catalog::InputError;
using catalog::Point;

/// A vertex may stand this far in front of a face plane of its own part, in sizes of the part: rounding of stored
/// shapes.
constexpr Real kConvexityTolerance = 1e-6;
/// A face corner may stand this far off its plane, and the face areas of a closed part may miss their balance by this
/// share, in sizes of the part (squared).
constexpr Real kClosureTolerance = 1e-6;
/// Parts may share this share of the body's volume; more counts mass and contact twice.
constexpr Real kLargestOverlap = 1e-3;
/// Thinnest part, as volume over size cubed: below it the part is taken as flat.
constexpr Real kFlatness = 1e-6;

Vec3 to_vec3(const Point& p) { return {p[0], p[1], p[2]}; }
Point to_point(const Vec3& v) { return {v.x, v.y, v.z}; }

std::string shown(Real value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", double(value));
  return text;
}

[[noreturn]] void refuse(const std::string& name, std::size_t part, const std::string& what) {
  throw InputError("shape '" + name + "', part " + std::to_string(part) + ": " + what);
}

Real size_of(const ConvexPart& part) {
  Real size = 0;
  for (const Point& vertex : part.vertices) size = std::max(size, norm(to_vec3(vertex) - to_vec3(part.vertices[0])));
  return size;
}

void check_part(const std::string& name, std::size_t index, const ConvexPart& part) {
  const auto limit = [&](std::size_t count, int largest, const std::string& what) {
    if (count > static_cast<std::size_t>(largest))
      refuse(name, index, std::to_string(count) + " " + what + ", the engine takes at most " + std::to_string(largest));
  };
  if (part.vertices.size() < 4 || part.faces.size() < 4) refuse(name, index, "fewer than four vertices or faces");
  limit(part.vertices.size(), kMaxPartVertices, "vertices");
  limit(part.faces.size(), kMaxPartFaces, "faces");
  const Real size = size_of(part);
  Vec3 area_sum;
  for (const ConvexFace& face : part.faces) {
    if (face.vertices.size() < 3) refuse(name, index, "a face with fewer than three corners");
    limit(face.vertices.size(), kMaxFaceCorners, "corners of one face");
    const Vec3 normal = to_vec3(face.plane.normal);
    if (!(std::abs(norm(normal) - 1) < 1e-6)) refuse(name, index, "a face plane without a unit normal");
    for (const int corner : face.vertices)
      if (corner < 0 || corner >= static_cast<int>(part.vertices.size()))
        refuse(name, index, "a face corner that is no vertex");
    const auto corner = [&](std::size_t c) { return to_vec3(part.vertices[face.vertices[c]]); };
    for (std::size_t c = 0; c < face.vertices.size(); ++c)
      if (!(std::abs(dot(normal, corner(c)) - face.plane.offset) < kClosureTolerance * size))
        refuse(name, index, "a face whose corners do not lie on its plane");
    for (std::size_t c = 2; c < face.vertices.size(); ++c)
      area_sum += Real(0.5) * cross(corner(c - 1) - corner(0), corner(c) - corner(0));
    for (const Point& vertex : part.vertices)
      if (!(dot(normal, to_vec3(vertex)) - face.plane.offset < kConvexityTolerance * size))
        refuse(name, index, "not convex");
  }
  // The vector areas of a closed surface sum to zero.
  if (!(norm(area_sum) < kClosureTolerance * size * size)) refuse(name, index, "open: faces are missing");
  const Real volume = catalog::volume_moments(catalog::triangulated(part)).volume;
  if (!(volume > kFlatness * size * size * size))
    refuse(name, index, "flat or inside out (" + shown(volume) + " m3 within " + shown(size) + " m)");
}

/// Rows of `axes` become x, y, z.
ConvexPart moved(const ConvexPart& part, const Point& centre, const catalog::Matrix3& axes) {
  const auto turn = [&](const Vec3& v) {
    return Vec3{dot(to_vec3(axes[0]), v), dot(to_vec3(axes[1]), v), dot(to_vec3(axes[2]), v)};
  };
  ConvexPart result = part;
  for (Point& vertex : result.vertices) vertex = to_point(turn(to_vec3(vertex) - to_vec3(centre)));
  for (ConvexFace& face : result.faces) {
    face.plane.offset -= dot(to_vec3(face.plane.normal), to_vec3(centre));
    face.plane.normal = to_point(turn(to_vec3(face.plane.normal)));
  }
  return result;
}

void check_partition(const Shape& shape) {
  const HostShapeColumns columns = make_host_shape_columns({shape}, std::nullopt);
  const ShapeView shapes = view(columns);
  const Pose as_it_is{};
  const Real radius = columns.shapes[0].bounding_radius;
  const BodyFrames same(as_it_is, as_it_is, radius, radius);
  Real shared = 0;
  for (int i = 0; i < columns.shapes[0].part_count; ++i)
    for (int j = i + 1; j < columns.shapes[0].part_count; ++j) {
      VolumeIntegrals integrals;
      SeparatingPlane separating = 0;
      Real distance = 0;
      integrate_overlap(part_view(shapes, i), part_view(shapes, j), same, separating, integrals, distance);
      shared += std::max(Real(0), integrals.volume);
    }
  if (shared > kLargestOverlap * shape.volume)
    throw InputError("shape '" + shape.name + "': its parts overlap by " + std::to_string(100 * shared / shape.volume) +
                     " % of the volume, which would count mass and contact twice; parts must be a partition");
}

}  // namespace

Shape sphere_shape(const std::string& name, Real radius) {
  if (!(radius > 0)) throw InputError("sphere '" + name + "': radius must be positive");
  Shape shape{name, SphereShape{radius}, 4 * std::numbers::pi / 3 * radius * radius * radius, {}};
  const Real inertia = Real(0.4) * shape.volume * radius * radius;
  shape.principal_inertia = {inertia, inertia, inertia};
  return shape;
}

catalog::ConvexPart box_part(const Vec3& size) {
  ConvexPart part;
  for (int corner = 0; corner < 8; ++corner)
    part.vertices.push_back(
        {(corner & 1 ? 0.5 : -0.5) * size.x, (corner & 2 ? 0.5 : -0.5) * size.y, (corner & 4 ? 0.5 : -0.5) * size.z});
  const std::vector<std::vector<int>> loops{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const Real half[3] = {size.x / 2, size.y / 2, size.z / 2};
  for (int f = 0; f < 6; ++f) {
    Point normal{0, 0, 0};
    normal[f / 2] = f % 2 ? 1 : -1;
    part.faces.push_back({loops[f], {normal, half[f / 2]}, catalog::FaceKind::outer});
  }
  return part;
}

Shape polyhedral_shape(const std::string& name, const std::vector<ConvexPart>& parts) {
  if (parts.empty()) throw InputError("shape '" + name + "': no parts");
  catalog::VolumeMoments moments;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    check_part(name, p, parts[p]);
    moments += catalog::volume_moments(catalog::triangulated(parts[p]));
  }
  const catalog::MassProperties mass = catalog::mass_properties(moments);
  PolyhedralShape polyhedron;
  for (const ConvexPart& part : parts) polyhedron.parts.push_back(moved(part, mass.centroid, mass.principal_axes));
  Shape shape{name, std::move(polyhedron), mass.volume, to_vec3(mass.principal_inertia)};
  check_partition(shape);
  return shape;
}

}  // namespace dem_gpu
