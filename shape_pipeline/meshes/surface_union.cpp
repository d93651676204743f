// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/surface_union.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <utility>

#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

std::optional<catalog::TriangleMesh> united(const std::vector<catalog::TriangleMesh>& bodies) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace PMP = CGAL::Polygon_mesh_processing;

  SurfaceMesh whole;
  for (const catalog::TriangleMesh& body : bodies) {
    SurfaceMesh surface, result;
    if (!copy_to_surface_mesh(body, surface)) return std::nullopt;
    if (whole.is_empty()) {
      whole = std::move(surface);
      continue;
    }
    const auto careful = CGAL::parameters::throw_on_self_intersection(true);
    try {
      if (!PMP::corefine_and_compute_union(whole, surface, result, careful, careful)) return std::nullopt;
    } catch (const PMP::Corefinement::Self_intersection_exception&) {
      return std::nullopt;
    }
    result.collect_garbage();
    whole = std::move(result);
  }
  return copy_from_surface_mesh(whole);
}

}  // namespace shape_pipeline
