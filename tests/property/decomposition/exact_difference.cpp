// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/decomposition/exact_difference.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>

#include <array>
#include <cmath>
namespace exact {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Nef nef_of(const catalog::TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const catalog::Point& p : mesh.vertices) points.emplace_back(p[0], p[1], p[2]);
  const std::vector<catalog::Triangle> faces = mesh.faces;
  CGAL::Polyhedron_3<Kernel> surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, surface);
  return Nef(surface);
}

/// Sum over the corners of each facet cycle that the void sees, by signed tetrahedra to the origin; holes run the other
/// way round, so that they count as such.
double volume_of(const Nef& solid) {
  using Point = std::array<double, 3>;
  double six_volumes = 0;
  for (auto facet = solid.halffacets_begin(); facet != solid.halffacets_end(); ++facet) {
    if (facet->incident_volume()->mark()) continue;
    for (auto cycle = facet->facet_cycles_begin(); cycle != facet->facet_cycles_end(); ++cycle) {
      if (!cycle.is_shalfedge()) continue;
      std::vector<Point> corners;
      Nef::SHalfedge_around_facet_const_circulator corner{Nef::SHalfedge_const_handle(cycle)}, end = corner;
      CGAL_For_all(corner, end) {
        const auto& p = corner->source()->center_vertex()->point();
        corners.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
      }
      for (std::size_t k = 2; k < corners.size(); ++k) {
        const Point &a = corners[0], &b = corners[k - 1], &c = corners[k];
        six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
    }
  }
  return std::abs(six_volumes) / 6;  // the orientation is the same for all
}

}  // namespace

Volumes volumes(const catalog::TriangleMesh& mesh, const std::vector<catalog::ConvexPart>& parts) {
  const Nef solid = nef_of(mesh);
  Volumes result;
  result.mesh = volume_of(solid);
  for (const catalog::ConvexPart& part : parts) {
    const Nef piece = nef_of(catalog::triangulated(part));
    result.parts += volume_of(piece);
    result.common += volume_of(solid * piece);
  }
  return result;
}

}  // namespace exact
