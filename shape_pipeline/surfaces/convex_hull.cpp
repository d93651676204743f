// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

catalog::TriangleMesh convex_hull(const std::vector<catalog::Point>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> kernel_points;
  kernel_points.reserve(points.size());
  for (const catalog::Point& p : points) kernel_points.emplace_back(p[0], p[1], p[2]);
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(kernel_points.begin(), kernel_points.end(), hull);
  if (hull.number_of_faces() < 4) return {};
  // The faces come in the order of addresses.
  catalog::TriangleMesh result = copy_from_surface_mesh(hull);
  put_in_canonical_order(result);
  return result;
}

}  // namespace shape_pipeline
