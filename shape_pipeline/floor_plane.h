// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// A cloud without the turntable or floor that its grains stand on.
struct ClearedCloud {
  PointCloud cloud;                    // what stands above the plane
  catalog::Point normal{};             // of the plane, towards the grains
  double offset = 0;                   // of the plane: dot(normal, point) on it [m]
  double noise = 0;                    // standard deviation of its points [m]
  std::vector<catalog::Check> checks;  // "floor_points", "floor_noise", "floor_beneath"
};

/// The plane with most points that has the rest on one side and reaches past it, found by sample consensus (Fischler &
/// Bolles 1981) and least squares; its points, to five standard deviations, and what lies beneath are left out. Throws
/// InputError, naming the cloud, where there is no such plane or nothing stands on it.
ClearedCloud without_floor(const PointCloud& cloud, const std::string& name);

/// Points of one grain.
struct PlateGrains {
  std::vector<PointCloud> grains;  // at least `least_points` each, most points first
  std::vector<std::size_t> small;  // points of each that has fewer, but is no speck
  std::size_t specks = 0;          // points in clusters of less than 50, dropped
  double gap = 0;                  // distance that separates two grains [m]
};

/// Clusters of points that are nearer than three spacings (PCL's Euclidean clusters): grains that touch are one.
PlateGrains separated_grains(const PointCloud& cloud, std::size_t least_points = 500);

}  // namespace shape_pipeline
