// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/registration/point_features.h"

#include <pcl/features/fpfh.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <iterator>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {

std::vector<PointFeature> point_features(const PointCloud& cloud, double radius) {
  // PCL holds single precision: the origin is moved to the first point.
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Point p = subtract(cloud.points[i], cloud.points.front());
    const Point& n = cloud.normals[i];
    points->push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    normals->push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
  }
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(points);
  estimation.setInputNormals(normals);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<pcl::FPFHSignature33> signatures;
  estimation.compute(signatures);
  std::vector<PointFeature> features(signatures.size());
  for (std::size_t i = 0; i < features.size(); ++i)
    std::copy(std::begin(signatures[i].histogram), std::end(signatures[i].histogram), features[i].begin());
  return features;
}

}  // namespace shape_pipeline
