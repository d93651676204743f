// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/solids/polyhedra.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kRounding = 1e-12;  // relative, of a volume by sums over a few dozen triangles
constexpr double kShake = 0.35;      // of a half-space's normal, over its length

BuiltSolid hull_solid(const std::vector<Point>& points, double exact_volume) {
  return {convex_hull(points), 0, exact_volume, kRounding};
}

/// The points with every change of signs.
std::vector<Point> mirrored(const std::vector<Point>& points) {
  std::vector<Point> all;
  for (const Point& p : points)
    for (int signs = 0; signs < 8; ++signs) {
      Point q = p;
      bool is_new = true;
      for (int i = 0; i < 3; ++i)
        if (signs >> i & 1) is_new = is_new && p[i] != 0, q[i] = -q[i];
      if (is_new) all.push_back(q);
    }
  return all;
}

std::vector<Point> with_cyclic_permutations(const std::vector<Point>& points) {
  std::vector<Point> all;
  for (const Point& p : points) all.insert(all.end(), {p, {p[1], p[2], p[0]}, {p[2], p[0], p[1]}});
  return all;
}

}  // namespace

BuiltSolid tetrahedron_solid() {  // edge sqrt(8)
  return hull_solid({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 8.0 / 3);
}

BuiltSolid cube_solid() { return hull_solid(mirrored({{1, 1, 1}}), 8); }

BuiltSolid octahedron_solid() { return hull_solid(mirrored(with_cyclic_permutations({{1, 0, 0}})), 4.0 / 3); }

BuiltSolid dodecahedron_solid() {
  constexpr double g = std::numbers::phi;
  std::vector<Point> points = with_cyclic_permutations({{0, 1 / g, g}});
  points.push_back({1, 1, 1});
  const double edge = 2 / g;
  return hull_solid(mirrored(points), (15 + 7 * std::sqrt(5.0)) / 4 * edge * edge * edge);
}

BuiltSolid icosahedron_solid() {  // edge 2
  return hull_solid(mirrored(with_cyclic_permutations({{0, 1, std::numbers::phi}})), 5 * (3 + std::sqrt(5.0)) / 12 * 8);
}

BuiltSolid truncated_tetrahedron_solid() {
  std::vector<Point> points;
  for (const Point& p : with_cyclic_permutations({{3, 1, 1}}))
    points.insert(points.end(), {p, {p[0], -p[1], -p[2]}, {-p[0], p[1], -p[2]}, {-p[0], -p[1], p[2]}});
  const double edge = std::sqrt(8.0);
  return hull_solid(points, 23 * std::numbers::sqrt2 / 12 * edge * edge * edge);
}

BuiltSolid bilunabirotunda_solid() {
  constexpr double g = std::numbers::phi, h = 1 / g;  // the squares lie in y = +-1, edge 2 h
  return hull_solid(mirrored({{0, 0, 1}, {h, 1, h}, {g, h, 0}}), (17 + 9 * std::sqrt(5.0)) / 12 * 8 * h * h * h);
}

BuiltSolid hexagonal_prism_solid(double length) {
  const double high = std::sqrt(3.0) / 2;
  return hull_solid(mirrored({{1, 0, length / 2}, {0.5, high, length / 2}}), 1.5 * std::sqrt(3.0) * length);
}

BuiltSolid crushed_rock_solid(int facets, double spread, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Point> poles;  // of the half-spaces n . x <= d: n / d
  for (int k = 0; k < facets; ++k) {
    // A spiral spreads the normals, so that the intersection is bounded whatever is drawn.
    const double z = 1 - (2.0 * k + 1) / facets, r = std::sqrt(1 - z * z);
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const Point even{r * std::cos(angle), r * std::sin(angle), z};
    const Point normal = normalized(add(even, scaled(random.direction(), kShake)));
    poles.push_back(scaled(normal, 1 / random.uniform(1 - spread, 1)));
  }
  // A face n . y = d of the poles' hull is a corner n / d of the rock.
  const catalog::TriangleMesh dual = convex_hull(poles);
  std::vector<Point> corners;
  for (const auto& [a, b, c] : dual.faces) {
    const Point& origin = dual.vertices[a];
    const Point normal = cross(subtract(dual.vertices[b], origin), subtract(dual.vertices[c], origin));
    corners.push_back(scaled(normal, 1 / dot(normal, origin)));
  }
  return {convex_hull(corners), 0, std::nullopt, 0};
}

}  // namespace shape_pipeline
