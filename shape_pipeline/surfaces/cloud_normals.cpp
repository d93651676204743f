// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/cloud_normals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <utility>
#include <vector>

namespace shape_pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OrientedPoint = std::pair<Kernel::Point_3, Kernel::Vector_3>;

}  // namespace

PointCloud with_estimated_normals(const PointCloud& cloud, int neighbours) {
  std::vector<OrientedPoint> points;
  points.reserve(cloud.points.size());
  for (const catalog::Point& p : cloud.points)
    points.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), CGAL::NULL_VECTOR);
  const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<OrientedPoint>())
                        .normal_map(CGAL::Second_of_pair_property_map<OrientedPoint>());
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(points, static_cast<unsigned int>(neighbours), maps);
  const auto unoriented = CGAL::mst_orient_normals(points, static_cast<unsigned int>(neighbours), maps);

  PointCloud result;
  for (auto entry = points.begin(); entry != unoriented; ++entry) {
    const auto& [p, n] = *entry;
    result.points.push_back({p.x(), p.y(), p.z()});
    result.normals.push_back({n.x(), n.y(), n.z()});
  }
  return result;
}

}  // namespace shape_pipeline
