// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <utility>
#include <vector>

#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> self_intersecting_faces(const catalog::TriangleMesh& mesh) {
  SurfaceMesh surface;
  copy_to_surface_mesh(mesh, surface);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  PMP::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  std::vector<std::pair<std::size_t, std::size_t>> faces;
  for (const auto& [a, b] : pairs) faces.emplace_back(a.idx(), b.idx());
  return faces;
}

std::size_t count_self_intersections(const catalog::TriangleMesh& mesh) { return self_intersecting_faces(mesh).size(); }

catalog::TriangleMesh without_self_intersections(const catalog::TriangleMesh& mesh) {
  SurfaceMesh surface;
  if (!copy_to_surface_mesh(mesh, surface)) return mesh;
  PMP::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(true));
  surface.collect_garbage();
  return copy_from_surface_mesh(surface);
}

}  // namespace shape_pipeline
