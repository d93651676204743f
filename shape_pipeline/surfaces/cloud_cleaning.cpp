// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/cloud_cleaning.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kOutlierNeighbours = 12;       // enough to see past a pair of stray points
constexpr double kOutlierDeviations = 5;     // standard deviations above the mean: scans are uneven, strays are far
constexpr double kDuplicateDistance = 1e-6;  // of the diagonal: below any scanner's resolution

/// Keeps the points with the given indices, in their order. Returns how many went.
std::size_t keep(PointCloud& cloud, const std::vector<int>& indices) {
  PointCloud kept;
  for (const int i : indices) {
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
  }
  const std::size_t removed = cloud.points.size() - kept.points.size();
  cloud = std::move(kept);
  return removed;
}

/// First point of each cell of the given width [m].
std::vector<int> first_per_cell(const std::vector<Point>& points, double width) {
  std::set<std::array<long long, 3>> seen;
  std::vector<int> first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<long long, 3> cell;
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<long long>(std::floor((points[i][k] - points[0][k]) / width));
    if (seen.insert(cell).second) first.push_back(static_cast<int>(i));
  }
  return first;
}

}  // namespace

std::size_t merge_duplicate_points(PointCloud& cloud) {
  return keep(cloud, first_per_cell(cloud.points, kDuplicateDistance * bounding_diagonal(cloud.points)));
}

std::size_t remove_outliers(PointCloud& cloud) {
  // PCL holds single precision: the origin is moved to the first point; the points kept are the originals.
  const auto input = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Point& point : cloud.points) {
    const Point p = subtract(point, cloud.points.front());
    input->push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(input);
  filter.setMeanK(kOutlierNeighbours);
  filter.setStddevMulThresh(kOutlierDeviations);
  std::vector<int> inliers;
  filter.filter(inliers);
  return keep(cloud, inliers);
}

std::size_t thin_out(PointCloud& cloud, std::size_t limit) {
  const std::size_t before = cloud.points.size();
  // The count falls with the square of the width: one guess from the box, then growing steps.
  for (double width = bounding_diagonal(cloud.points) / std::sqrt(4.0 * static_cast<double>(limit));
       cloud.points.size() > limit; width *= 1.1) {
    const std::vector<int> first = first_per_cell(cloud.points, width);
    if (first.size() <= limit) keep(cloud, first);
  }
  return before - cloud.points.size();
}

}  // namespace shape_pipeline
