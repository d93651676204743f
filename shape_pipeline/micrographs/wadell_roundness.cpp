// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/wadell_roundness.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "shape_pipeline/micrographs/plane_geometry.h"

namespace shape_pipeline {
namespace {

constexpr int kPoints = 720;
constexpr double kSmoothedShare = 0.015;  // of the perimeter, to either side
constexpr double kSmoothedPixels = 3;     // what a pixelated edge may wave over
constexpr double kLeastTurn = 0.1;        // [rad]; less is noise
constexpr double kInsideShare = 0.98;     // of the radius; Zheng & Hryciw 2015
constexpr int kFewestPoints = 5;          // of a fitted circle

/// Points at equal arc lengths.
Outline resampled(const Outline& outline, int count) {
  Outline points;
  const double step = perimeter(outline) / count;
  double passed = 0, next = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    for (; next < passed + length && static_cast<int>(points.size()) < count; next += step) {
      const double t = (next - passed) / length;
      points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    passed += length;
  }
  return points;
}

struct CurvedOutline {
  Outline points;                 // smoothed
  std::vector<double> curvature;  // positive where convex
  double step = 0;                // arc between neighbours

  std::size_t at(int i) const { return static_cast<std::size_t>(i) % points.size(); }
};

CurvedOutline smoothed(const Outline& outline, double pixel) {
  const Outline raw = resampled(outline, kPoints);
  const int n = static_cast<int>(raw.size());
  CurvedOutline result;
  result.step = perimeter(outline) / n;
  const double reach = std::max(kSmoothedShare * result.step * n, kSmoothedPixels * pixel);
  const int half = std::clamp(static_cast<int>(std::lround(reach / result.step)), 2, n / 4);
  // The weights are the same at every point, so the regression is three fixed rows.
  Eigen::MatrixXd powers(2 * half + 1, 3);
  Eigen::VectorXd weights(2 * half + 1);
  for (int k = -half; k <= half; ++k) {
    const double t = k * result.step;
    powers.row(k + half) << 1, t, t * t;
    weights[k + half] = std::pow(1 - std::pow(std::abs(k) / (half + 1.0), 3), 3);
  }
  const Eigen::MatrixXd weighted = weights.asDiagonal() * powers;
  const Eigen::MatrixXd rows = (powers.transpose() * weighted).ldlt().solve(weighted.transpose());
  for (int i = 0; i < n; ++i) {
    Eigen::Matrix<double, 3, 2> fit = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = -half; k <= half; ++k) {
      const PlanePoint& p = raw[static_cast<std::size_t>((i + k + n) % n)];
      fit += rows.col(k + half) * Eigen::RowVector2d(p[0], p[1]);
    }
    result.points.push_back({fit(0, 0), fit(0, 1)});
    const double speed = std::hypot(fit(1, 0), fit(1, 1));
    result.curvature.push_back(2 * (fit(1, 0) * fit(2, 1) - fit(1, 1) * fit(2, 0)) / (speed * speed * speed));
  }
  return result;
}

struct Circle {
  PlanePoint centre{};
  double radius = 0;
};

/// Least squares of x^2 + y^2 = D x + E y + F (Kasa 1976), good here where points are smooth and corners turn far.
Circle fitted_circle(const CurvedOutline& outline, int first, int count) {
  const PlanePoint origin = outline.points[outline.at(first)];
  Eigen::MatrixXd rows(count, 3);
  Eigen::VectorXd right(count);
  for (int k = 0; k < count; ++k) {
    const PlanePoint& p = outline.points[outline.at(first + k)];
    const double x = (p[0] - origin[0]) / outline.step, y = (p[1] - origin[1]) / outline.step;
    rows.row(k) << x, y, 1;
    right[k] = x * x + y * y;
  }
  const Eigen::Vector3d fit = rows.colPivHouseholderQr().solve(right);
  const double x = fit[0] / 2, y = fit[1] / 2;
  return {{origin[0] + x * outline.step, origin[1] + y * outline.step},
          std::sqrt(std::max(0.0, fit[2] + x * x + y * y)) * outline.step};
}

/// Radius of the circle in the corner of `count` points from `first` on.
double corner_radius(const CurvedOutline& outline, int first, int count) {
  double sharpest = 0;
  for (int k = 0; k < count; ++k) sharpest = std::max(sharpest, outline.curvature[outline.at(first + k)]);
  for (; count >= kFewestPoints; first += 1, count -= 2) {
    const Circle circle = fitted_circle(outline, first, count);
    if (depth_inside(outline.points, circle.centre) >= kInsideShare * circle.radius) return circle.radius;
  }
  return 1 / sharpest;
}

}  // namespace

double wadell_roundness(const Outline& outline, double inscribed_radius, double pixel) {
  const CurvedOutline curved = smoothed(with_positive_area(outline), pixel);
  const int n = static_cast<int>(curved.points.size());
  const auto is_corner = [&](int i) { return curved.curvature[curved.at(i)] * inscribed_radius > 1; };
  int start = 0;
  while (start < n && is_corner(start)) ++start;  // begin outside of a corner
  if (start == n) return 1;
  double sum = 0;
  int corners = 0;
  for (int i = start; i < start + n; ++i) {
    const int first = i;
    double turn = 0;
    for (; i < start + n && is_corner(i); ++i)
      turn += curved.step * (curved.curvature[curved.at(i)] - 1 / inscribed_radius);
    if (turn < kLeastTurn) continue;
    sum += std::min(1.0, corner_radius(curved, first, i - first) / inscribed_radius);
    ++corners;
  }
  return corners ? sum / corners : 1;
}

}  // namespace shape_pipeline
