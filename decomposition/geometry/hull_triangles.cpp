// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>

#include "decomposition/geometry/faceted_hull.h"

namespace decomposition {

std::vector<std::array<int, 3>> hull_triangles(const std::vector<Vec3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  std::map<std::array<double, 3>, int> index;
  std::vector<Point> cgal_points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (index.try_emplace({points[i].x, points[i].y, points[i].z}, static_cast<int>(i)).second)
      cgal_points.emplace_back(points[i].x, points[i].y, points[i].z);
  std::vector<std::array<int, 3>> triangles;
  if (cgal_points.size() < 4) return triangles;
  CGAL::Surface_mesh<Point> mesh;
  CGAL::convex_hull_3(cgal_points.begin(), cgal_points.end(), mesh);
  if (mesh.number_of_faces() < 4) return triangles;
  for (const auto face : mesh.faces()) {
    std::array<int, 3> triangle{};
    std::size_t corner = 0;
    for (const auto vertex : vertices_around_face(mesh.halfedge(face), mesh)) {
      const Point& p = mesh.point(vertex);
      if (corner < 3) triangle[corner++] = index.at({p.x(), p.y(), p.z()});
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
  // The library goes through its facets in the order of their addresses.
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace decomposition
