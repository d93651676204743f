// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/scan_extent.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "catalog/mass_properties.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kFlatRatio = 1e-4;  // spread across / spread along: no particle is that thin, no scanner that exact
constexpr double kSmallestSize = 1e-12, kLargestCoordinate = 1e12;  // [m]

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", length);
  return text;
}

/// Standard deviations along the principal axes, from the least up.
Point spread_of(const std::vector<catalog::Point>& points, const Point& mean) {
  catalog::Matrix3 covariance{};
  for (const Point& p : points) {
    const Point d = subtract(p, mean);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance[i][j] += d[i] * d[j];
  }
  Point variance;
  catalog::Matrix3 axes;
  catalog::symmetric_eigen(covariance, variance, axes);
  Point spread;
  for (int i = 0; i < 3; ++i) spread[i] = std::sqrt(std::max(variance[i], 0.0));
  return spread;
}

Point mean_of(const std::vector<catalog::Point>& points) {
  Point mean{};
  for (const Point& p : points) mean = add(mean, scaled(p, 1.0 / static_cast<double>(points.size())));
  return mean;
}

}  // namespace

bool are_flat(const std::vector<catalog::Point>& points) {
  const Point spread = spread_of(points, mean_of(points));
  return !(spread[0] > kFlatRatio * spread[2]);
}

void refuse_flat_scan(const std::filesystem::path& path, const std::vector<catalog::Point>& points) {
  const Point mean = mean_of(points), spread = spread_of(points, mean);
  if (spread[0] > kFlatRatio * spread[2]) return;
  // Sums of equal coordinates leave a spread of rounding errors.
  double largest = 0;
  for (const double coordinate : mean) largest = std::max(largest, std::abs(coordinate));
  const double rounding = 1e-12 * largest * static_cast<double>(points.size());
  const std::string found = !(spread[2] > rounding)               ? "all points are in one place"
                            : spread[1] <= kFlatRatio * spread[2] ? "all points lie on one line"
                                                                  : "all points lie in one plane";
  refuse_file(path, "points", "expected a solid particle, but " + found,
              "scan it from all sides; of bodies far apart, each alone");
}

void refuse_impossible_size(const std::filesystem::path& path, const std::vector<catalog::Point>& points) {
  double largest = 0;
  for (const Point& p : points)
    for (const double coordinate : p) largest = std::max(largest, std::abs(coordinate));
  if (largest > kLargestCoordinate)
    refuse_file(path, "points", "expected coordinates up to 1e12 m, found " + metres(largest), "check the unit");
  if (const double size = bounding_diagonal(points); size < kSmallestSize)
    refuse_file(path, "points", "expected a particle of at least 1e-12 m, found " + metres(size), "check the unit");
}

}  // namespace shape_pipeline
