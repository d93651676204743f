// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <utility>

#include "shape_pipeline/floor_plane.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kGapSpacings = 3;  // scans are uneven: within a grain, hardly a point is farther from the next
constexpr std::size_t kSpeckPoints = 50;

PointCloud chosen(const PointCloud& cloud, const std::vector<int>& indices) {
  PointCloud result;
  for (const int i : indices) {
    result.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

}  // namespace

PlateGrains separated_grains(const PointCloud& cloud, std::size_t least_points) {
  PlateGrains result;
  result.gap = kGapSpacings * average_spacing(cloud.points);
  // PCL holds single precision: the origin is moved to the first point.
  const auto input = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Point& point : cloud.points) {
    const Point p = subtract(point, cloud.points.front());
    input->push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(input);
  extraction.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  extraction.setClusterTolerance(result.gap);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  // Most points first; of equal ones that with the first point.
  for (pcl::PointIndices& cluster : clusters) std::sort(cluster.indices.begin(), cluster.indices.end());
  std::sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
    return a.indices.size() != b.indices.size() ? a.indices.size() > b.indices.size() : a.indices < b.indices;
  });
  for (const pcl::PointIndices& cluster : clusters) {
    const std::size_t points = cluster.indices.size();
    if (points >= least_points)
      result.grains.push_back(chosen(cloud, cluster.indices));
    else if (points >= kSpeckPoints)
      result.small.push_back(points);
    else
      result.specks += points;
  }
  return result;
}

}  // namespace shape_pipeline
