// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bench_shapes.h"

#include <cmath>
#include <numbers>

#include "catalog/mass_properties.h"

namespace workflows {
namespace {

using catalog::ConvexPart;
using catalog::FaceKind;
using dem_gpu::Vec3;

ConvexPart shifted(ConvexPart part, const Vec3& by) {
  for (catalog::Point& vertex : part.vertices) vertex = {vertex[0] + by.x, vertex[1] + by.y, vertex[2] + by.z};
  for (catalog::ConvexFace& face : part.faces)
    face.plane.offset += face.plane.normal[0] * by.x + face.plane.normal[1] * by.y + face.plane.normal[2] * by.z;
  return part;
}

/// Box between two corners; faces named by axis and side, as box_part orders them: 2 * axis + (1 for the upper side).
ConvexPart box_between(const Vec3& low, const Vec3& high, const std::vector<int>& inner_faces) {
  ConvexPart part = shifted(dem_gpu::box_part(high - low), 0.5 * (low + high));
  for (const int face : inner_faces) part.faces[face].kind = FaceKind::inner;
  return part;
}

ConvexPart polyhedron(const std::vector<catalog::Point>& vertices, const std::vector<std::vector<int>>& loops) {
  ConvexPart part;
  part.vertices = vertices;
  const auto at = [&](int v) { return Vec3{vertices[v][0], vertices[v][1], vertices[v][2]}; };
  for (std::vector<int> loop : loops) {
    Vec3 normal = cross(at(loop[1]) - at(loop[0]), at(loop[2]) - at(loop[0]));
    normal = normal / norm(normal);
    double offset = dot(normal, at(loop[0]));
    if (offset < 0) {  // The origin lies inside.
      std::swap(loop[1], loop[2]);
      normal = -normal;
      offset = -offset;
    }
    part.faces.push_back({loop, {{normal.x, normal.y, normal.z}, offset}, FaceKind::outer});
  }
  return part;
}

}  // namespace

dem_gpu::Shape shape_as_given(const std::string& name, std::vector<ConvexPart> parts) {
  double volume = 0;
  for (const ConvexPart& part : parts) volume += catalog::volume_moments(catalog::triangulated(part)).volume;
  return {name, dem_gpu::PolyhedralShape{std::move(parts)}, volume, {}};
}

dem_gpu::Shape box_shape(const Vec3& size) { return shape_as_given("box", {dem_gpu::box_part(size)}); }

dem_gpu::Shape cut_box_shape(const Vec3& size, const std::array<int, 3>& cuts) {
  std::vector<ConvexPart> parts;
  const auto corner = [&](int i, int j, int k) {
    return Vec3{size.x * (double(i) / cuts[0] - 0.5), size.y * (double(j) / cuts[1] - 0.5),
                size.z * (double(k) / cuts[2] - 0.5)};
  };
  for (int i = 0; i < cuts[0]; ++i)
    for (int j = 0; j < cuts[1]; ++j)
      for (int k = 0; k < cuts[2]; ++k) {
        const std::array<int, 3> cell{i, j, k};
        std::vector<int> inner;
        for (int axis = 0; axis < 3; ++axis) {
          if (cell[axis] > 0) inner.push_back(2 * axis);
          if (cell[axis] < cuts[axis] - 1) inner.push_back(2 * axis + 1);
        }
        parts.push_back(box_between(corner(i, j, k), corner(i + 1, j + 1, k + 1), inner));
      }
  return shape_as_given("cut box", std::move(parts));
}

dem_gpu::Shape l_shape(int part_count) {
  const double h = 0.5;
  // Squares at the lower left, lower right and upper left; the inner corner is at the origin.
  if (part_count == 3)
    return shape_as_given("L in 3",
                          {box_between({-1, -1, -h}, {0, 0, h}, {1, 3}), box_between({0, -1, -h}, {1, 0, h}, {0}),
                           box_between({-1, 0, -h}, {0, 1, h}, {2})});
  // The lower bar's top is cut over half of it, so it has an outer and an inner face in one plane: not a box any more.
  ConvexPart bar = box_between({-1, -1, -h}, {1, 0, h}, {});
  const int near_low = static_cast<int>(bar.vertices.size());
  bar.vertices.push_back({0, 0, -h});
  bar.vertices.push_back({0, 0, h});
  const auto plane = bar.faces[3].plane;
  bar.faces[3] = {{near_low, near_low + 1, 7, 3}, plane, FaceKind::outer};
  bar.faces.push_back({{2, 6, near_low + 1, near_low}, plane, FaceKind::inner});
  return shape_as_given("L in 2", {bar, box_between({-1, 0, -h}, {0, 1, h}, {2})});
}

dem_gpu::Shape tetrahedron_shape() {
  const double h = 0.5;
  return shape_as_given("tetrahedron", {polyhedron({{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}},
                                                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})});
}

dem_gpu::Shape octahedron_shape() {
  return shape_as_given(
      "octahedron",
      {polyhedron({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})});
}

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

dem_gpu::Quaternion random_rotation(std::mt19937_64& random) {
  const double share = uniform(random, 0, 1), a = uniform(random, 0, 2 * std::numbers::pi),
               b = uniform(random, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - share), s = std::sqrt(share);
  return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

Vec3 random_direction(std::mt19937_64& random) {
  const double z = uniform(random, -1, 1), angle = uniform(random, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

double touch_distance(const dem_gpu::OverlapProbe& probe, const dem_gpu::PosePair& poses, const Vec3& direction,
                      double reach) {
  double touching = 0, apart = reach;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (touching + apart);
    dem_gpu::PosePair trial = poses;
    trial.b.position = trial.a.position + middle * direction;
    (probe.overlap(trial).volume > 0 ? touching : apart) = middle;
  }
  return apart;
}

}  // namespace workflows
