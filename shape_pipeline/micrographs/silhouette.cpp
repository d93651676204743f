// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// Directions evenly turned, and how far along each the segments reach that were added.
class RayFan {
 public:
  explicit RayFan(int rays) : radii_(static_cast<std::size_t>(rays), 0.0) {
    for (int k = 0; k < rays; ++k)
      directions_.push_back({std::cos(2 * std::numbers::pi * k / rays), std::sin(2 * std::numbers::pi * k / rays)});
  }

  void add(const PlanePoint& a, const PlanePoint& b) {
    const double turn = 2 * std::numbers::pi, rays = static_cast<double>(radii_.size());
    double first = std::atan2(a[1], a[0]), last = std::atan2(b[1], b[0]);
    if (std::abs(last - first) > std::numbers::pi) (first < last ? first : last) += turn;
    if (first > last) std::swap(first, last);
    const double area = a[0] * b[1] - a[1] * b[0];
    const auto end = static_cast<long>(std::floor(last / turn * rays));
    for (long k = static_cast<long>(std::ceil(first / turn * rays)); k <= end; ++k) {
      const auto ray =
          static_cast<std::size_t>((k % static_cast<long>(rays) + static_cast<long>(rays)) % static_cast<long>(rays));
      const PlanePoint& u = directions_[ray];
      const double across = u[0] * (b[1] - a[1]) - u[1] * (b[0] - a[0]);
      if (across != 0) radii_[ray] = std::max(radii_[ray], area / across);
    }
  }

  const std::vector<double>& radii() const { return radii_; }

  Outline outline() const {
    Outline points;
    for (std::size_t k = 0; k < radii_.size(); ++k)
      points.push_back({radii_[k] * directions_[k][0], radii_[k] * directions_[k][1]});
    return points;
  }

 private:
  std::vector<PlanePoint> directions_;
  std::vector<double> radii_;
};

}  // namespace

Outline star_silhouette(const catalog::TriangleMesh& mesh, const catalog::Point& view, int rays) {
  const Point seed = std::abs(view[2]) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0};
  const Point right = normalized(cross(seed, view)), up = cross(view, right);
  std::vector<PlanePoint> seen;
  for (const Point& vertex : mesh.vertices) seen.push_back({dot(vertex, right), dot(vertex, up)});
  RayFan fan(rays);
  for (const catalog::Triangle& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (a < b) fan.add(seen[static_cast<std::size_t>(a)], seen[static_cast<std::size_t>(b)]);  // each edge once
    }
  return fan.outline();
}

std::vector<double> ray_radii(const Outline& outline, const PlanePoint& centre, int rays) {
  RayFan fan(rays);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    fan.add({a[0] - centre[0], a[1] - centre[1]}, {b[0] - centre[0], b[1] - centre[1]});
  }
  return fan.radii();
}

}  // namespace shape_pipeline
