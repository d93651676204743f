// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/families/hull_blend.h"

#include <algorithm>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/convex_hull.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {

std::vector<catalog::Point> ways_to_hull(const catalog::TriangleMesh& mesh) {
  const catalog::TriangleMesh hull = convex_hull(mesh.vertices);
  std::vector<std::pair<Point, double>> planes;  // unit normal outward, offset
  for (const catalog::Triangle& face : hull.faces) {
    const Point& origin = hull.vertices[face[0]];
    const Point area = cross(subtract(hull.vertices[face[1]], origin), subtract(hull.vertices[face[2]], origin));
    if (!(norm(area) > 0)) continue;
    const Point normal = normalized(area);
    planes.emplace_back(normal, dot(normal, origin));
  }
  const double nearest = 1e-9 * bounding_diagonal(mesh.vertices);  // on the plane
  std::vector<catalog::Point> ways;
  for (const Point& p : mesh.vertices) {
    Point way{};
    double weights = 0;
    for (const auto& [normal, offset] : planes) {
      const double d = std::max(offset - dot(normal, p), nearest), weight = 1 / (d * d * d * d);
      way = add(way, scaled(normal, weight * d));
      weights += weight;
    }
    ways.push_back(scaled(way, 1 / weights));
  }
  return ways;
}

}  // namespace shape_pipeline
