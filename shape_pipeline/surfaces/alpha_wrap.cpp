// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

std::vector<Kernel::Point_3> kernel_points(const std::vector<catalog::Point>& points) {
  std::vector<Kernel::Point_3> result;
  result.reserve(points.size());
  for (const catalog::Point& p : points) result.emplace_back(p[0], p[1], p[2]);
  return result;
}

catalog::TriangleMesh in_canonical_order(catalog::TriangleMesh mesh) {
  put_in_canonical_order(mesh);
  return mesh;
}

}  // namespace

catalog::TriangleMesh alpha_wrap(const std::vector<catalog::Point>& points, double alpha, double offset) {
  SurfaceMesh wrap;
  CGAL::alpha_wrap_3(kernel_points(points), alpha, offset, wrap);
  return in_canonical_order(copy_from_surface_mesh(wrap));
}

catalog::TriangleMesh alpha_wrap(const catalog::TriangleMesh& soup, double alpha, double offset) {
  SurfaceMesh wrap;
  CGAL::alpha_wrap_3(kernel_points(soup.vertices), soup.faces, alpha, offset, wrap);
  return in_canonical_order(copy_from_surface_mesh(wrap));
}

}  // namespace shape_pipeline
