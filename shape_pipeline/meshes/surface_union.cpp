// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/surface_union.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

std::optional<catalog::TriangleMesh> united(const catalog::TriangleMesh& a, const catalog::TriangleMesh& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace PMP = CGAL::Polygon_mesh_processing;

  SurfaceMesh first, second, result;
  if (!copy_to_surface_mesh(a, first) || !copy_to_surface_mesh(b, second)) return std::nullopt;
  const auto careful = CGAL::parameters::throw_on_self_intersection(true);
  try {
    if (!PMP::corefine_and_compute_union(first, second, result, careful, careful)) return std::nullopt;
  } catch (const PMP::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  result.collect_garbage();
  catalog::TriangleMesh mesh = copy_from_surface_mesh(result);
  put_in_canonical_order(mesh);
  return mesh;
}

}  // namespace shape_pipeline
