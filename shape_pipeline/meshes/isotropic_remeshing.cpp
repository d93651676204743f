// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/isotropic_remeshing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

catalog::TriangleMesh isotropic_remeshing(const catalog::TriangleMesh& mesh, double edge_length) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  constexpr unsigned int kIterations = 3;  // edge lengths settle within three rounds
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  if (!copy_to_surface_mesh(mesh, surface)) return {};
  CGAL::Polygon_mesh_processing::isotropic_remeshing(faces(surface), edge_length, surface,
                                                     CGAL::parameters::number_of_iterations(kIterations));
  surface.collect_garbage();
  return copy_from_surface_mesh(surface);
}

}  // namespace shape_pipeline
