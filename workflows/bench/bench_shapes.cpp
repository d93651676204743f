// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bench_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/mass_properties.h"

namespace workflows {
namespace {

using catalog::ConvexPart;
using catalog::FaceKind;
using dem_gpu::Vec3;

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

catalog::ConvexPart shifted(catalog::ConvexPart part, const Vec3& by) {
  for (catalog::Point& vertex : part.vertices) vertex = {vertex[0] + by.x, vertex[1] + by.y, vertex[2] + by.z};
  for (catalog::ConvexFace& face : part.faces)
    face.plane.offset += face.plane.normal[0] * by.x + face.plane.normal[1] * by.y + face.plane.normal[2] * by.z;
  return part;
}

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

dem_gpu::Shape cross_shape(int part_count) {
  const double h = 0.5, e = 1.5;
  const ConvexPart low = box_between({-h, -e, -h}, {h, -h, h}, {3}), high = box_between({-h, h, -h}, {h, e, h}, {2});
  if (part_count == 5)
    return shape_as_given("cross in 5",
                          {box_between({-h, -h, -h}, {h, h, h}, {0, 1, 2, 3}), low, high,
                           box_between({-e, -h, -h}, {-h, h, h}, {1}), box_between({h, -h, -h}, {e, h, h}, {0})});
  // A bar along x whose long sides are covered in the middle third.
  ConvexPart bar = box_between({-e, -h, -h}, {e, h, h}, {});
  for (const int side : {2, 3}) {
    const double y = side == 2 ? -h : h;
    const int first = static_cast<int>(bar.vertices.size());
    for (const double x : {-e, -h, h, e})
      for (const double z : {-h, h}) bar.vertices.push_back({x, y, z});
    const auto plane = bar.faces[static_cast<std::size_t>(side)].plane;
    for (int third = 0; third < 3; ++third) {
      const int v = first + 2 * third;
      std::vector<int> loop{v, v + 2, v + 3, v + 1};
      if (side == 3) std::reverse(loop.begin(), loop.end());
      const catalog::ConvexFace face{loop, plane, third == 1 ? FaceKind::inner : FaceKind::outer};
      if (third == 0)
        bar.faces[static_cast<std::size_t>(side)] = face;
      else
        bar.faces.push_back(face);
    }
  }
  return shape_as_given("cross in 3", {bar, low, high});
}

dem_gpu::Shape rough_rock_shape() {
  // Corners and edge middles of an octahedron, moved to a bumpy sphere.
  const auto placed = [](const Vec3& x) {
    const Vec3 u = x / norm(x);
    return (1 + 0.12 * std::sin(4 * u.x + 1) * std::cos(5 * u.y) + 0.1 * std::sin(6 * u.z + 2 * u.x)) * u;
  };
  std::vector<ConvexPart> parts;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    ConvexPart part;
    for (const Vec3& vertex : {Vec3{}, placed(a), placed(b), placed(c)})
      part.vertices.push_back({vertex.x, vertex.y, vertex.z});
    const auto at = [&](int v) { return Vec3{part.vertices[v][0], part.vertices[v][1], part.vertices[v][2]}; };
    for (const std::vector<int>& loop : {std::vector<int>{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}}) {
      const Vec3 normal = cross(at(loop[1]) - at(loop[0]), at(loop[2]) - at(loop[0]));
      const Vec3 unit = normal / norm(normal);
      part.faces.push_back(
          {loop, {{unit.x, unit.y, unit.z}, dot(unit, at(loop[0]))}, loop[0] == 0 ? FaceKind::inner : FaceKind::outer});
    }
    parts.push_back(std::move(part));
  };
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0}) {
        const bool is_even = x * y * z > 0;
        const Vec3 a{x, 0, 0}, b = is_even ? Vec3{0, y, 0} : Vec3{0, 0, z}, c = is_even ? Vec3{0, 0, z} : Vec3{0, y, 0};
        add(a, a + b, a + c);
        add(a + b, b, b + c);
        add(a + c, b + c, c);
        add(a + b, b + c, a + c);
      }
  return shape_as_given("rough rock", std::move(parts));
}

dem_gpu::Shape bridge_shape() {
  const double w = 0.25, foot = -0.5, under = -0.48, top = 0;
  // Faces are whole: the posts' sides above the bridge's underside are covered, the strips below it bare.
  ConvexPart left = box_between({-0.5, -w, foot}, {-0.2, w, top}, {}),
             right = box_between({0.2, -w, foot}, {0.5, w, top}, {});
  const auto split = [&](ConvexPart& post, int side, double x) {
    const int first = static_cast<int>(post.vertices.size());
    for (const double z : {foot, under, top})
      for (const double y : {-w, w}) post.vertices.push_back({x, y, z});
    const auto plane = post.faces[static_cast<std::size_t>(side)].plane;
    std::vector<int> bare{first, first + 1, first + 3, first + 2}, covered{first + 2, first + 3, first + 5, first + 4};
    if (side == 0) {
      std::reverse(bare.begin(), bare.end());
      std::reverse(covered.begin(), covered.end());
    }
    post.faces[static_cast<std::size_t>(side)] = {bare, plane, FaceKind::outer};
    post.faces.push_back({covered, plane, FaceKind::inner});
  };
  split(left, 1, -0.2);
  split(right, 0, 0.2);
  return shape_as_given("bridge", {left, right, box_between({-0.2, -w, under}, {0.2, w, top}, {0, 1})});
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
