// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/inscribed_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surfaces/small_linear_program.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kChords = 400;      // whose middles are tried
constexpr std::size_t kClimbs = 6;        // starts, the best chord middles that lie apart
constexpr std::size_t kMostBounds = 120;  // faces in one linear program, the nearest ones
constexpr double kFirstReach = 0.3;       // of a step, over the radius
constexpr double kLastReach = 1e-10;      // over the radius: what is left is rounding
constexpr int kMostSteps = 120;

/// Where the line from `origin` along `direction` leaves through a face, nearest first (Moller & Trumbore 1997).
std::optional<double> chord_length(const catalog::TriangleMesh& mesh, const Point& origin, const Point& direction,
                                   double least) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& corner = mesh.vertices[face[0]];
    const Point e1 = subtract(mesh.vertices[face[1]], corner), e2 = subtract(mesh.vertices[face[2]], corner);
    const Point across = cross(direction, e2);
    const double determinant = dot(e1, across);
    if (determinant == 0) continue;
    const Point arm = subtract(origin, corner);
    const double u = dot(arm, across) / determinant;
    if (u < 0 || u > 1) continue;
    const Point turned = cross(arm, e1);
    const double v = dot(direction, turned) / determinant;
    if (v < 0 || u + v > 1) continue;
    const double length = dot(e2, turned) / determinant;
    if (length > least) nearest = std::min(nearest, length);
  }
  return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

/// Middles of chords that run inwards from faces spread evenly by area: all inside the solid.
std::vector<Point> chord_middles(const catalog::TriangleMesh& mesh) {
  const double area = surface_area(mesh), least = 1e-9 * bounding_diagonal(mesh.vertices);
  std::vector<Point> middles;
  double passed = 0, next = area / (2 * kChords);
  for (const catalog::Triangle& face : mesh.faces) {
    const Point &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
    const Point twice_area = cross(subtract(b, a), subtract(c, a));
    const double own = norm(twice_area) / 2;
    passed += own;
    for (int n = 0; passed >= next && own > 0; ++n, next += area / kChords) {
      // Points of an additive sequence over the triangle, so that a large face gives different chords.
      double u = std::fmod(1.0 / 3 + n * 0.7548776662466927, 1), v = std::fmod(1.0 / 3 + n * 0.5698402909980532, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Point origin = add(a, add(scaled(subtract(b, a), u), scaled(subtract(c, a), v)));
      const Point inwards = scaled(normalized(twice_area), -1);
      if (const auto length = chord_length(mesh, origin, inwards, least))
        middles.push_back(add(origin, scaled(inwards, *length / 2)));
    }
  }
  return middles;
}

class Climb {
 public:
  Climb(const catalog::TriangleMesh& mesh, const Point& start)
      : mesh_(mesh), centre_(start), radius_(clearance(start)) {}

  InscribedSphere top() {
    double reach = kFirstReach;
    for (int step = 0; step < kMostSteps && reach > kLastReach; ++step) {
      const Point candidate = add(centre_, raising_step(bounds(reach * radius_), reach * radius_));
      const double radius = clearance(candidate);
      if (radius > radius_ * (1 + 1e-13)) {
        centre_ = candidate;
        radius_ = radius;
      } else {
        reach /= 4;
      }
    }
    return {centre_, radius_};
  }

 private:
  Point nearest(std::size_t face, const Point& p) const {
    const auto& [a, b, c] = mesh_.faces[face];
    return nearest_in_triangle(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
  }

  double clearance(const Point& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const Point way = subtract(p, nearest(f, p));
      least = std::min(least, dot(way, way));
    }
    return std::sqrt(least);
  }

  /// Distances of the faces that a step of so much may bring near, linear in the step.
  std::vector<LinearBound> bounds(double reach) const {
    std::vector<std::pair<double, Point>> near;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const Point way = subtract(centre_, nearest(f, centre_));
      const double length = norm(way);
      if (length <= radius_ + 4 * reach && length > 0) near.emplace_back(length, scaled(way, 1 / length));
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<LinearBound> result;
    for (const auto& [length, gradient] : near) {
      const Point& direction = gradient;
      const bool is_known = std::any_of(result.begin(), result.end(), [&](const LinearBound& other) {
        return 1 - dot(other.gradient, direction) < 1e-9;  // the nearer face holds already
      });
      if (!is_known) result.push_back({gradient, length});
      if (result.size() == kMostBounds) break;
    }
    return result;
  }

  const catalog::TriangleMesh& mesh_;
  Point centre_;
  double radius_;
};

}  // namespace

Point nearest_in_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = subtract(b, a), ac = subtract(c, a), ap = subtract(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Point bp = subtract(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return add(a, scaled(ab, d1 / (d1 - d3)));
  const Point cp = subtract(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return add(a, scaled(ac, d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return add(b, scaled(subtract(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6))));
  return add(a, add(scaled(ab, vb / (va + vb + vc)), scaled(ac, vc / (va + vb + vc))));
}

InscribedSphere inscribed_sphere(const catalog::TriangleMesh& mesh) {
  const std::vector<Point> middles = chord_middles(mesh);
  const std::vector<double> clearances = distances_to_surface(middles, mesh);
  std::vector<std::pair<double, Point>> starts;
  for (std::size_t k = 0; k < middles.size(); ++k) starts.emplace_back(clearances[k], middles[k]);
  std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });

  InscribedSphere largest;
  std::vector<Point> tried;
  for (const auto& [clearance, start] : starts) {
    if (tried.size() == kClimbs) break;
    const double apart = clearance / 2;
    const Point& middle = start;
    if (std::any_of(tried.begin(), tried.end(), [&](const Point& p) { return distance(p, middle) < apart; })) continue;
    tried.push_back(start);
    const InscribedSphere found = Climb(mesh, start).top();
    if (found.radius > largest.radius) largest = found;
  }
  return largest;
}

}  // namespace shape_pipeline
