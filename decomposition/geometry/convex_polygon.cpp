// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/convex_polygon.h"

#include <algorithm>
#include <numeric>

namespace decomposition {
namespace {

double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Keeps the side of a polygon where `height` is not negative; `blend(p, q, t)` is the point at share t from p to q.
template <class Point, class Height, class Blend>
std::vector<Point> keep_above(const std::vector<Point>& polygon, const Height& height, const Blend& blend) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double hp = height(p), hq = height(q);
    if (hp >= 0) kept.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) kept.push_back(blend(p, q, hp / (hp - hq)));
  }
  return kept;
}

}  // namespace

double area(const Polygon2& polygon) {
  double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) twice += turn(polygon[0], polygon[k - 1], polygon[k]);
  return twice / 2;
}

Polygon2 intersection(Polygon2 subject, const Polygon2& clip) {
  const auto blend = [](const Point2& p, const Point2& q, double t) {
    return Point2{p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
  };
  for (std::size_t k = 0; k < clip.size() && !subject.empty(); ++k) {
    const Point2 &a = clip[k], &b = clip[(k + 1) % clip.size()];
    subject = keep_above(
        subject, [&](const Point2& p) { return turn(a, b, p); }, blend);
  }
  return subject;
}

std::vector<Vec3> clip(std::vector<Vec3> polygon, const std::vector<Plane>& planes) {
  const auto blend = [](const Vec3& p, const Vec3& q, double t) { return p + t * (q - p); };
  for (const Plane& plane : planes) {
    if (polygon.empty()) break;
    polygon = keep_above(
        polygon, [&](const Vec3& p) { return -plane.signed_distance(p); }, blend);
  }
  return polygon;
}

std::vector<int> convex_hull(const std::vector<Point2>& points, double tolerance) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) -> const Point2& { return points[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a) < at(b); });
  // Andrew's monotone chain, lower side then upper side.
  std::vector<int> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const int i : order) {
      const auto stands_out = [&](int a, int b, int c) {
        const double base = std::hypot(at(c)[0] - at(a)[0], at(c)[1] - at(a)[1]);
        return turn(at(a), at(b), at(c)) > tolerance * base;
      };
      while (hull.size() >= start + 2 && !stands_out(hull[hull.size() - 2], hull.back(), i)) hull.pop_back();
      hull.push_back(i);
    }
    hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

}  // namespace decomposition
