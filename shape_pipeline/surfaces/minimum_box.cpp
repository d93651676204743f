// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/minimum_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "shape_pipeline/surfaces/optimal_box.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kFaceCandidates = 60;  // largest distinct hull face directions tried as a box side
constexpr double kSameDirection = 1e-9;      // 1 - cosine of two face normals that are one direction
constexpr double kGain = 1e-12;              // relative gain below which turning stops

using Flat = std::array<double, 2>;

std::pair<double, double> range_along(const std::vector<Point>& points, const Point& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& p : points) {
    const double along = dot(p, direction);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return {low, high};
}

double extent_along(const std::vector<Point>& points, const Point& direction) {
  const auto [low, high] = range_along(points, direction);
  return high - low;
}

/// Convex hull in the plane, counter-clockwise (Andrew 1979).
std::vector<Flat> flat_hull(std::vector<Flat> points) {
  std::sort(points.begin(), points.end());
  const auto turn = [](const Flat& a, const Flat& b, const Flat& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  std::vector<Flat> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Flat& p : points) {
      while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Smallest box with one side across `axis`: its other sides are flush with an edge of the points' outline along it.
OrientedBox box_about(const std::vector<Point>& points, const Point& axis) {
  const Point seed = std::abs(axis[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point u = normalized(cross(axis, seed)), v = cross(axis, u);
  std::vector<Flat> outline;
  outline.reserve(points.size());
  for (const Point& p : points) outline.push_back({dot(p, u), dot(p, v)});
  outline = flat_hull(std::move(outline));

  const double height = extent_along(points, axis);
  double least_area = std::numeric_limits<double>::infinity();
  OrientedBox box;
  for (std::size_t e = 0; e < outline.size(); ++e) {
    const Flat &from = outline[e], &to = outline[(e + 1) % outline.size()];
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    if (!(length > 0)) continue;
    const double c = (to[0] - from[0]) / length, s = (to[1] - from[1]) / length;
    double low_a = std::numeric_limits<double>::infinity(), high_a = -low_a, low_b = low_a, high_b = -low_a;
    for (const Flat& p : outline) {
      const double a = c * p[0] + s * p[1], b = c * p[1] - s * p[0];
      low_a = std::min(low_a, a), high_a = std::max(high_a, a);
      low_b = std::min(low_b, b), high_b = std::max(high_b, b);
    }
    const double area = (high_a - low_a) * (high_b - low_b);
    if (area >= least_area) continue;
    least_area = area;
    const Point side = add(scaled(u, c), scaled(v, s));
    box = {{axis, side, cross(axis, side)}, {height, high_a - low_a, high_b - low_b}};
  }
  return box;
}

/// Turns the box about each of its axes in turn as long as that makes it smaller.
OrientedBox turned(const std::vector<Point>& points, OrientedBox box) {
  for (bool is_better = true; is_better;) {
    is_better = false;
    for (const Point& axis : catalog::Matrix3(box.axes)) {
      const OrientedBox candidate = box_about(points, axis);
      if (candidate.volume() < box.volume() * (1 - kGain)) {
        box = candidate;
        is_better = true;
      }
    }
  }
  return box;
}

/// Distinct directions of the hull's faces, those of largest area first.
std::vector<Point> face_directions(const catalog::TriangleMesh& hull) {
  std::vector<std::pair<double, Point>> faces;
  for (const catalog::Triangle& face : hull.faces) {
    const Point& origin = hull.vertices[face[0]];
    const Point area = cross(subtract(hull.vertices[face[1]], origin), subtract(hull.vertices[face[2]], origin));
    if (norm(area) > 0) faces.emplace_back(norm(area), normalized(area));
  }
  std::stable_sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Point> directions;
  for (const auto& [area, direction] : faces) {
    if (directions.size() >= kFaceCandidates) break;
    const Point& normal = direction;
    const bool is_known = std::any_of(directions.begin(), directions.end(), [&](const Point& other) {
      return 1 - std::abs(dot(other, normal)) < kSameDirection;
    });
    if (!is_known) directions.push_back(normal);
  }
  return directions;
}

}  // namespace

OrientedBox minimum_volume_box(const catalog::TriangleMesh& hull) {
  OrientedBox best;
  best.extent.fill(std::numeric_limits<double>::infinity());
  const auto consider = [&](const Point& axis) {
    const OrientedBox box = box_about(hull.vertices, axis);
    if (box.volume() < best.volume() * (1 - kGain)) best = box;
  };
  for (const Point& direction : face_directions(hull)) consider(direction);
  for (const Point& axis : optimal_box_axes(hull.vertices)) consider(axis);
  return turned(hull.vertices, best);
}

}  // namespace shape_pipeline
