// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/enclosing_sphere.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

namespace shape_pipeline {

double enclosing_radius(const std::vector<catalog::Point>& points) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> kernel_points;
  kernel_points.reserve(points.size());
  for (const catalog::Point& p : points) kernel_points.emplace_back(p[0], p[1], p[2]);
  CGAL::Min_sphere_of_spheres_d<Traits> sphere(kernel_points.begin(), kernel_points.end());
  return sphere.is_empty() ? 0 : CGAL::to_double(sphere.radius());
}

}  // namespace shape_pipeline
