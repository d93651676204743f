// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "dem_gpu/scene.h"
#include "tests/support/sample_shapes.h"

namespace test_support {

using dem_gpu::Quaternion;
using dem_gpu::Real;
using dem_gpu::Vec3;

inline Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }
inline catalog::Point to_point(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Part with the given face loops (counter-clockwise seen from outside); planes follow from the corners.
inline catalog::ConvexPart part_of(const std::vector<Vec3>& vertices, const std::vector<std::vector<int>>& loops) {
  catalog::ConvexPart part;
  for (const Vec3& vertex : vertices) part.vertices.push_back(to_point(vertex));
  for (const std::vector<int>& loop : loops) {
    const Vec3 a = vertices[loop[0]];
    Vec3 normal;  // of the whole loop: three corners may lie on a line
    for (std::size_t c = 2; c < loop.size(); ++c) normal += cross(vertices[loop[c - 1]] - a, vertices[loop[c]] - a);
    const Vec3 unit = normal / norm(normal);
    part.faces.push_back({loop, {to_point(unit), dot(unit, a)}, catalog::FaceKind::outer});
  }
  return part;
}

/// Hull of points in general position: every triple with all others on one side is a face. O(n^4): for few points.
inline catalog::ConvexPart hull_of(const std::vector<Vec3>& points) {
  std::vector<std::vector<int>> loops;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        const Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
        int above = 0, below = 0;
        for (int m = 0; m < n; ++m) {
          if (m == i || m == j || m == k) continue;
          (dot(normal, points[m] - points[i]) > 0 ? above : below) += 1;
        }
        if (above == 0) loops.push_back({i, j, k});
        if (below == 0) loops.push_back({i, k, j});
      }
  return part_of(points, loops);
}

inline Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<Real> normal;
  const Vec3 v{normal(random), normal(random), normal(random)};
  return v / norm(v);
}

inline Quaternion random_rotation(std::mt19937& random) {
  std::normal_distribution<Real> normal;
  return dem_gpu::normalized({normal(random), normal(random), normal(random), normal(random)});
}

/// Convex part with `vertices` corners on an ellipsoid of half-axes `half`.
inline catalog::ConvexPart random_convex_part(std::mt19937& random, int vertices, const Vec3& half = {1, 1, 1}) {
  std::vector<Vec3> points;
  for (int i = 0; i < vertices; ++i) points.push_back(hadamard(half, random_direction(random)));
  return hull_of(points);
}

inline catalog::ConvexPart unit_cube() { return dem_gpu::box_part({1, 1, 1}); }

/// Regular tetrahedron inscribed in the cube of edge `edge` about the origin.
inline catalog::ConvexPart tetrahedron(Real edge = 1, bool dual = false) {
  const Real h = (dual ? -1 : 1) * edge / 2;
  const std::vector<Vec3> vertices{{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}};
  return hull_of(vertices);
}

/// |x| + |y| + |z| <= reach.
inline catalog::ConvexPart octahedron(Real reach) {
  return hull_of({{reach, 0, 0}, {-reach, 0, 0}, {0, reach, 0}, {0, -reach, 0}, {0, 0, reach}, {0, 0, -reach}});
}

inline catalog::ConvexPart moved_part(catalog::ConvexPart part, const Quaternion& turn, const Vec3& shift) {
  for (catalog::Point& vertex : part.vertices) vertex = to_point(rotate(turn, to_vec3(vertex)) + shift);
  for (catalog::ConvexFace& face : part.faces) {
    const Vec3 normal = rotate(turn, to_vec3(face.plane.normal));
    face.plane = {to_point(normal), face.plane.offset + dot(normal, shift)};
  }
  return part;
}

/// Grid boxes `cells` (index triples) with edges at `cuts`[axis]; faces shared by two boxes are inner.
inline std::vector<catalog::ConvexPart> grid_parts(const std::vector<std::array<int, 3>>& cells,
                                                   const std::array<std::vector<Real>, 3>& cuts) {
  std::vector<catalog::ConvexPart> parts;
  for (const auto& cell : cells) {
    catalog::Point low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = cuts[axis][cell[axis]];
      high[axis] = cuts[axis][cell[axis] + 1];
    }
    catalog::ConvexPart part = box_part(low, high);
    for (int face = 0; face < 6; ++face) {
      auto neighbour = cell;
      neighbour[face / 2] += face % 2 ? 1 : -1;
      if (std::find(cells.begin(), cells.end(), neighbour) != cells.end())
        part.faces[face].kind = catalog::FaceKind::inner;
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Box of edges `size` about the origin cut into counts[0] x counts[1] x counts[2] equal parts.
inline std::vector<catalog::ConvexPart> cut_box(const Vec3& size, const std::array<int, 3>& counts) {
  const Real edges[3] = {size.x, size.y, size.z};
  std::array<std::vector<Real>, 3> cuts;
  std::vector<std::array<int, 3>> cells;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= counts[axis]; ++i) cuts[axis].push_back(edges[axis] * (Real(i) / counts[axis] - Real(0.5)));
  for (int x = 0; x < counts[0]; ++x)
    for (int y = 0; y < counts[1]; ++y)
      for (int z = 0; z < counts[2]; ++z) cells.push_back({x, y, z});
  return grid_parts(cells, cuts);
}

/// Frame kept as given: for tests that need to know the body frame. The box must have its centre at the origin.
inline dem_gpu::Shape box_shape(const Vec3& size, const std::array<int, 3>& counts = {1, 1, 1}) {
  const Real volume = size.x * size.y * size.z;
  const auto inertia = [&](Real a, Real b) { return volume * (a * a + b * b) / 12; };
  return {"box",
          dem_gpu::PolyhedralShape{cut_box(size, counts)},
          volume,
          {inertia(size.y, size.z), inertia(size.x, size.z), inertia(size.x, size.y)}};
}

/// One material of 2500 kg/m3, no gravity, no bodies.
inline dem_gpu::Scene empty_scene(Real restitution, Real friction) {
  dem_gpu::Scene scene;
  scene.name = "test";
  scene.gravity = {};
  scene.materials = {{"rock", 2500}};
  scene.contact = {{{restitution, friction}}};
  scene.friction = friction > 0 ? std::optional(dem_gpu::Friction{}) : std::nullopt;
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.sphere_law = dem_gpu::LinearSpring{1e5};
  scene.run.end_time = 1;
  return scene;
}

inline dem_gpu::Wall floor_wall(const std::string& name = "floor") {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::Plane{{0, 0, 0}, {0, 0, 1}};
  return wall;
}

/// Closed room [0, size] of six planes.
inline std::vector<dem_gpu::Wall> room(const Vec3& size) {
  std::vector<dem_gpu::Wall> walls;
  const Vec3 normals[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    dem_gpu::Wall low, high;
    low.name = "low" + std::to_string(axis);
    high.name = "high" + std::to_string(axis);
    low.geometry = dem_gpu::Plane{{0, 0, 0}, normals[axis]};
    high.geometry = dem_gpu::Plane{size, -normals[axis]};
    low.contact_class = high.contact_class = "room";
    walls.push_back(low);
    walls.push_back(high);
  }
  return walls;
}

inline dem_gpu::Body body_at(int shape, const Vec3& position, const Quaternion& orientation = {},
                             const Vec3& velocity = {}) {
  dem_gpu::Body body;
  body.shape = shape;
  body.position = position;
  body.orientation = orientation;
  body.velocity = velocity;
  return body;
}

/// Turns the unit vector `from` into `to`.
inline Quaternion turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const Real sine = norm(axis);
  if (sine == 0) return dot(from, to) > 0 ? Quaternion{} : dem_gpu::axis_angle(dem_gpu::any_perpendicular(from), M_PI);
  return dem_gpu::axis_angle(axis / sine, std::atan2(sine, dot(from, to)));
}

inline Quaternion edge_down() { return dem_gpu::axis_angle({1, 0, 0}, M_PI / 4); }
inline Quaternion vertex_down() {
  const Real c = 1 / std::sqrt(Real(3));
  return turn_between({-c, -c, -c}, {0, 0, -1});
}

}  // namespace test_support
