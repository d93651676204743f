// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/soup_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {

catalog::TriangleMesh oriented_manifold(const catalog::TriangleMesh& soup) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  namespace PMP = CGAL::Polygon_mesh_processing;

  std::vector<Kernel::Point_3> points;
  points.reserve(soup.vertices.size());
  for (const catalog::Point& p : soup.vertices) points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::vector<std::size_t>> polygons;
  polygons.reserve(soup.faces.size());
  for (const catalog::Triangle& face : soup.faces)
    polygons.push_back(
        {static_cast<std::size_t>(face[0]), static_cast<std::size_t>(face[1]), static_cast<std::size_t>(face[2])});
  PMP::orient_polygon_soup(points, polygons);
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  PMP::stitch_borders(mesh);
  return copy_from_surface_mesh(mesh);
}

}  // namespace shape_pipeline
