// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/plane_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace shape_pipeline {
namespace {

double turn(const PlanePoint& o, const PlanePoint& a, const PlanePoint& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double squared_distance(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], length = ux * ux + uy * uy;
  const double along = length > 0 ? std::clamp(((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / length, 0.0, 1.0) : 0;
  const double dx = p[0] - a[0] - along * ux, dy = p[1] - a[1] - along * uy;
  return dx * dx + dy * dy;
}

/// A square that may hold the centre of the largest circle.
struct Square {
  PlanePoint centre{};
  double half = 0, depth = 0;
  double bound() const { return depth + half * std::numbers::sqrt2; }
  friend bool operator<(const Square& a, const Square& b) { return a.bound() < b.bound(); }
};

/// Steps uphill from a centre, of halved length where none helps, down to 1e-9 of the depth.
double climbed_depth(const Outline& outline, Square best) {
  constexpr int kDirections = 32;
  const double least = 1e-9 * best.depth;
  for (double step = best.half; step > least;) {
    bool climbs = false;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * k / kDirections;
      const PlanePoint next{best.centre[0] + step * std::cos(angle), best.centre[1] + step * std::sin(angle)};
      const double depth = depth_inside(outline, next);
      if (depth <= best.depth * (1 + 1e-12)) continue;
      best.centre = next;
      best.depth = depth;
      climbs = true;
    }
    if (!climbs) step /= 2;
  }
  return best.depth;
}

double extent_along(const Outline& points, double ux, double uy) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlanePoint& p : points) {
    low = std::min(low, p[0] * ux + p[1] * uy);
    high = std::max(high, p[0] * ux + p[1] * uy);
  }
  return high - low;
}

}  // namespace

PlaneMoments plane_moments(const Outline& outline) {
  // About the first corner, so that far-away outlines lose no digits.
  const PlanePoint origin = outline.front();
  double area = 0, sx = 0, sy = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double ax = p[0] - origin[0], ay = p[1] - origin[1], bx = q[0] - origin[0], by = q[1] - origin[1];
    const double w = ax * by - ay * bx;
    area += w / 2;
    sx += w * (ax + bx) / 6;
    sy += w * (ay + by) / 6;
    xx += w * (ax * ax + ax * bx + bx * bx) / 12;
    yy += w * (ay * ay + ay * by + by * by) / 12;
    xy += w * (2 * ax * ay + ax * by + bx * ay + 2 * bx * by) / 24;
  }
  if (area == 0) return {};
  const double cx = sx / area, cy = sy / area;
  return {area, {origin[0] + cx, origin[1] + cy}, xx / area - cx * cx, xy / area - cx * cy, yy / area - cy * cy};
}

FittedEllipse fitted_ellipse(const PlaneMoments& moments) {
  const double mean = (moments.xx + moments.yy) / 2;
  const double spread = std::hypot((moments.xx - moments.yy) / 2, moments.xy);
  const double root = std::pow((mean + spread) / std::max(mean - spread, 1e-12 * mean), 0.25);
  const double diameter = std::sqrt(4 * std::abs(moments.area) / std::numbers::pi);
  return {diameter * root, diameter / root, std::atan2(2 * moments.xy, moments.xx - moments.yy) / 2};
}

double perimeter(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint& next = outline[(i + 1) % outline.size()];
    sum += std::hypot(next[0] - outline[i][0], next[1] - outline[i][1]);
  }
  return sum;
}

Outline with_positive_area(Outline outline) {
  if (plane_moments(outline).area < 0) std::reverse(outline.begin(), outline.end());
  return outline;
}

Outline plane_hull(const Outline& points) {
  Outline sorted = points;
  std::sort(sorted.begin(), sorted.end());
  Outline hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *first) <= 0) hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // it begins the other chain
  };
  add_chain(sorted.begin(), sorted.end());
  add_chain(sorted.rbegin(), sorted.rend());
  return hull;
}

Calipers calipers(const Outline& hull) {
  Calipers result;
  PlanePoint along{1, 0};
  for (std::size_t i = 0; i < hull.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = hull[i][0] - hull[j][0], dy = hull[i][1] - hull[j][1], length = std::hypot(dx, dy);
      if (length <= result.feret_max) continue;
      result.feret_max = length;
      result.feret_max_angle = std::atan2(dy, dx);
      along = {dx / length, dy / length};
    }
  result.across_max = extent_along(hull, -along[1], along[0]);
  result.feret_min = result.box_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const PlanePoint& next = hull[(i + 1) % hull.size()];
    const double dx = next[0] - hull[i][0], dy = next[1] - hull[i][1], length = std::hypot(dx, dy);
    const double across = extent_along(hull, -dy / length, dx / length);
    result.feret_min = std::min(result.feret_min, across);
    result.box_area = std::min(result.box_area, across * extent_along(hull, dx / length, dy / length));
  }
  return result;
}

double depth_inside(const Outline& outline, const PlanePoint& point) {
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const PlanePoint &a = outline[i], &b = outline[j];
    least = std::min(least, squared_distance(point, a, b));
    if ((a[1] > point[1]) != (b[1] > point[1]) && point[0] < (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]) + a[0])
      is_inside = !is_inside;
  }
  return is_inside ? std::sqrt(least) : -std::sqrt(least);
}

double inscribed_circle_radius(const Outline& outline, double tolerance) {
  const PlaneMoments moments = plane_moments(outline);
  PlanePoint low = outline.front(), high = low;
  for (const PlanePoint& p : outline)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const auto square_at = [&](double x, double y, double half) {
    return Square{{x, y}, half, depth_inside(outline, {x, y})};
  };
  std::priority_queue<Square> open;
  open.push(
      square_at((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, std::max(high[0] - low[0], high[1] - low[1]) / 2));
  Square best = square_at(moments.centroid[0], moments.centroid[1], tolerance);
  while (!open.empty() && open.top().bound() > best.depth + tolerance) {
    const Square square = open.top();
    open.pop();
    for (const double dx : {-0.5, 0.5})
      for (const double dy : {-0.5, 0.5}) {
        const Square part =
            square_at(square.centre[0] + dx * square.half, square.centre[1] + dy * square.half, square.half / 2);
        if (part.depth > best.depth) best = part;
        if (part.bound() > best.depth + tolerance) open.push(part);
      }
  }
  return best.depth > 0 ? climbed_depth(outline, best) : 0;
}

std::vector<Outline> hull_pockets(const Outline& given) {
  const Outline outline = with_positive_area(given), hull = plane_hull(outline);
  const std::size_t n = outline.size();
  std::vector<std::size_t> on_hull;
  for (std::size_t i = 0; i < n; ++i)
    if (std::find(hull.begin(), hull.end(), outline[i]) != hull.end()) on_hull.push_back(i);
  std::vector<Outline> pockets;
  for (std::size_t k = 0; k < on_hull.size(); ++k) {
    const std::size_t last = on_hull[(k + 1) % on_hull.size()] + (k + 1 == on_hull.size() ? n : 0);
    Outline pocket;
    for (std::size_t i = on_hull[k]; i <= last; ++i) pocket.push_back(outline[i % n]);
    if (pocket.size() > 2) pockets.push_back(std::move(pocket));
  }
  return pockets;
}

}  // namespace shape_pipeline
