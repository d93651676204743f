// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/hole_filling.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kLongestExactLoop = 300;  // edges; the exact triangulation takes the cube of this in time

}  // namespace

HoleFilling fill_holes(catalog::TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace PMP = CGAL::Polygon_mesh_processing;

  HoleFilling filling;
  SurfaceMesh surface;
  if (!copy_to_surface_mesh(mesh, surface)) return filling;
  std::vector<SurfaceMesh::Halfedge_index> loops;
  PMP::extract_boundary_cycles(surface, std::back_inserter(loops));
  if (loops.empty()) return filling;
  for (const SurfaceMesh::Halfedge_index loop : loops) {
    std::vector<SurfaceMesh::Face_index> faces;
    std::vector<SurfaceMesh::Vertex_index> vertices;
    const auto length = halfedges_around_face(loop, surface).size();
    PMP::triangulate_refine_and_fair_hole(surface, loop, std::back_inserter(faces), std::back_inserter(vertices),
                                          CGAL::parameters::do_not_use_cubic_algorithm(length > kLongestExactLoop));
    ++(faces.empty() ? filling.left_open : filling.filled);
  }
  const double area_before = surface_area(mesh);
  mesh = copy_from_surface_mesh(surface);
  filling.filled_area = surface_area(mesh) - area_before;
  return filling;
}

}  // namespace shape_pipeline
