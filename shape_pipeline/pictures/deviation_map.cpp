// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "shape_pipeline/grain_pictures.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/surfaces/nearest_points.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/surfaces/winding_volume.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kMostPoints = 40000;  // of a source: as dense as the vertices of a shape, at most 10,000 or so
constexpr double kReach = 4;                // spacings of the points: farther away there is a gap

}  // namespace

DeviationMap with_statistics(std::vector<double> values) {
  DeviationMap map;
  std::vector<double> known;
  for (const double value : values)
    if (std::isfinite(value)) known.push_back(std::abs(value));
  map.share_without = values.empty() ? 0 : 1 - static_cast<double>(known.size()) / static_cast<double>(values.size());
  map.all = distance_statistics(std::move(known), 1);
  map.values = std::move(values);
  return map;
}

DeviationMap deviation_from_points(const catalog::TriangleMesh& result, const std::vector<Point>& points) {
  std::vector<Point> taken;
  const std::size_t step = std::max<std::size_t>(1, (points.size() + kMostPoints - 1) / kMostPoints);
  for (std::size_t i = 0; i < points.size(); i += step) taken.push_back(points[i]);
  std::vector<double> values(result.vertices.size(), std::numeric_limits<double>::quiet_NaN());
  if (taken.size() < 2) return with_statistics(std::move(values));
  const double reach = kReach * average_spacing(taken);
  const std::vector<double> outside = signed_distances_to_surface(taken, result);
  const NearestPoint nearest(taken);
  for (std::size_t v = 0; v < values.size(); ++v) {
    const auto point = static_cast<std::size_t>(nearest(result.vertices[v]));
    // A point outside the result: there the result lies inside its source.
    if (distance(taken[point], result.vertices[v]) <= reach) values[v] = -outside[point];
  }
  return with_statistics(std::move(values));
}

DeviationMap deviation_from_mesh(const catalog::TriangleMesh& result, const catalog::TriangleMesh& source) {
  std::vector<Point> points;
  for (const SurfaceElement& sample : surface_samples(source)) points.push_back(sample.centre);
  return deviation_from_points(result, points);
}

}  // namespace shape_pipeline
