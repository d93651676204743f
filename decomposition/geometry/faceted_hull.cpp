// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/faceted_hull.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "decomposition/geometry/coplanar_groups.h"

namespace decomposition {
namespace {

/// The boundary of each group as one loop; empty if a group has several.
std::vector<std::vector<int>> boundary_loops(const std::vector<std::array<int, 3>>& triangles,
                                             const CoplanarGroups& groups) {
  const std::vector<std::array<int, 3>> neighbours = face_neighbours(triangles);
  std::vector<std::map<int, int>> next(groups.planes.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const int group = groups.group_of[f];
    for (std::size_t k = 0; k < 3; ++k) {
      if (groups.group_of[static_cast<std::size_t>(neighbours[f][k])] == group) continue;
      const int from = triangles[f][k], to = triangles[f][(k + 1) % 3];
      if (!next[static_cast<std::size_t>(group)].emplace(from, to).second) return {};
    }
  }
  std::vector<std::vector<int>> loops;
  for (const auto& successor : next) {
    std::vector<int> loop;
    if (successor.empty()) return {};
    const int start = successor.begin()->first;
    int vertex = start;
    do {
      loop.push_back(vertex);
      const auto found = successor.find(vertex);
      if (found == successor.end() || loop.size() > successor.size()) return {};
      vertex = found->second;
    } while (vertex != start);
    if (loop.size() != successor.size()) return {};
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Plane through a polygon (Newell's normal), offset at the mean of its corners.
Plane plane_of(const std::vector<Vec3>& points, const std::vector<int>& polygon) {
  const Vec3 origin = points[static_cast<std::size_t>(polygon[0])];
  Vec3 normal, sum;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = points[static_cast<std::size_t>(polygon[k])] - origin;
    const Vec3 b = points[static_cast<std::size_t>(polygon[(k + 1) % polygon.size()])] - origin;
    normal += cross(a, b);
    sum += a;
  }
  Plane plane;
  plane.normal = normalized(normal);
  plane.offset = dot(plane.normal, origin) + dot(plane.normal, sum) / static_cast<double>(polygon.size());
  return plane;
}

int plane_holding(const Plane& plane, const std::vector<Vec3>& points, const std::vector<int>& polygon,
                  const std::vector<Plane>& given, double tolerance) {
  for (std::size_t g = 0; g < given.size(); ++g)
    if (dot(plane.normal, given[g].normal) > 0 && std::all_of(polygon.begin(), polygon.end(), [&](int v) {
          return std::abs(given[g].signed_distance(points[static_cast<std::size_t>(v)])) <= tolerance;
        }))
      return static_cast<int>(g);
  return -1;
}

}  // namespace

std::optional<FacetedHull> faceted_hull(std::vector<Vec3> points, const std::vector<Plane>& given, double tolerance) {
  std::vector<int> source(points.size());
  std::iota(source.begin(), source.end(), 0);
  while (true) {
    const std::vector<std::array<int, 3>> triangles = hull_triangles(points);
    if (triangles.empty()) return std::nullopt;
    const CoplanarGroups groups = coplanar_groups(points, triangles, tolerance);
    if (groups.count() < 4) return std::nullopt;
    // A corner belongs to three facets or more.
    std::vector<std::set<int>> touching(points.size());
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for (const int v : triangles[f]) touching[static_cast<std::size_t>(v)].insert(groups.group_of[f]);
    std::vector<Vec3> corners;
    std::vector<int> corner_source;
    for (std::size_t v = 0; v < points.size(); ++v)
      if (touching[v].size() >= 3) {
        corners.push_back(points[v]);
        corner_source.push_back(source[v]);
      }
    const bool is_settled = corners.size() == points.size();
    points = std::move(corners);
    source = std::move(corner_source);
    if (!is_settled) continue;
    const std::vector<std::vector<int>> loops = boundary_loops(triangles, groups);
    if (loops.empty()) return std::nullopt;
    FacetedHull hull{std::move(points), std::move(source), {}};
    for (const std::vector<int>& loop : loops) {
      Facet facet{loop, plane_of(hull.points, loop), -1};
      facet.given_plane = plane_holding(facet.plane, hull.points, loop, given, tolerance);
      if (facet.given_plane >= 0) facet.plane = given[static_cast<std::size_t>(facet.given_plane)];
      hull.facets.push_back(std::move(facet));
    }
    return hull;
  }
}

}  // namespace decomposition
