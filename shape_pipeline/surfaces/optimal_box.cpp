// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/optimal_box.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/optimal_bounding_box.h>

namespace shape_pipeline {

catalog::Matrix3 optimal_box_axes(const std::vector<catalog::Point>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> kernel_points;
  kernel_points.reserve(points.size());
  for (const catalog::Point& p : points) kernel_points.emplace_back(p[0], p[1], p[2]);
  std::array<Kernel::Point_3, 8> corners;
  // The search starts from random rotations: a fixed seed makes the box that of these points alone, whatever was looked
  // at before on this thread.
  CGAL::get_default_random() = CGAL::Random(1);
  CGAL::oriented_bounding_box(kernel_points, corners, CGAL::parameters::use_convex_hull(false));

  // Corners 1, 3 and 5 are the neighbours of corner 0.
  catalog::Matrix3 axes{};
  int row = 0;
  for (const int neighbour : {1, 3, 5}) {
    const Kernel::Vector_3 edge = corners[neighbour] - corners[0];
    const double length = CGAL::approximate_sqrt(edge.squared_length());
    axes[row++] = {edge.x() / length, edge.y() / length, edge.z() / length};
  }
  return axes;
}

}  // namespace shape_pipeline
