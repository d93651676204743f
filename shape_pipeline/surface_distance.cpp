// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surface_distance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace shape_pipeline {

std::vector<double> signed_distances_to_surface(const std::vector<catalog::Point>& points,
                                                const catalog::TriangleMesh& mesh) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

  Triangles triangles;
  triangles.reserve(mesh.faces.size());
  const auto corner = [&](int v) {
    const catalog::Point& p = mesh.vertices[v];
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  for (const catalog::Triangle& face : mesh.faces)
    triangles.emplace_back(corner(face[0]), corner(face[1]), corner(face[2]));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.cbegin(), triangles.cend());
  tree.build();
  tree.accelerate_distance_queries();

  std::vector<double> result;
  result.reserve(points.size());
  for (const catalog::Point& p : points) {
    const Kernel::Point_3 point(p[0], p[1], p[2]);
    const auto [closest, triangle] = tree.closest_point_and_primitive(point);
    const Kernel::Vector_3 way = point - closest;
    const double length = CGAL::approximate_sqrt(way.squared_length());
    const bool is_outside = way * triangle->supporting_plane().orthogonal_vector() >= 0;
    result.push_back(is_outside ? length : -length);
  }
  return result;
}

std::vector<double> distances_to_surface(const std::vector<catalog::Point>& points, const catalog::TriangleMesh& mesh) {
  std::vector<double> result = signed_distances_to_surface(points, mesh);
  for (double& distance : result) distance = distance < 0 ? -distance : distance;
  return result;
}

}  // namespace shape_pipeline
