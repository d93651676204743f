// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/edge_collapse.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

catalog::TriangleMesh collapsed_to(const catalog::TriangleMesh& mesh, std::size_t face_limit) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace SMS = CGAL::Surface_mesh_simplification;

  SurfaceMesh surface;
  if (!copy_to_surface_mesh(mesh, surface)) return {};
  // A closed triangle mesh has three edges for every two faces.
  const SMS::Count_stop_predicate<SurfaceMesh> stop(face_limit * 3 / 2 + 1);
  SMS::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(SMS::LindstromTurk_cost<SurfaceMesh>())
                         .get_placement(SMS::LindstromTurk_placement<SurfaceMesh>())
                         .filter(SMS::Bounded_normal_change_filter<>()));
  surface.collect_garbage();
  return copy_from_surface_mesh(surface);
}

}  // namespace shape_pipeline
