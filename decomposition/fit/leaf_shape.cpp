// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/leaf_shape.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <utility>

namespace decomposition {
namespace {

constexpr double kOnCut = 1e-8;  // share of the diagonal: nearer points lie on the cut
constexpr double kBulge = 1e-6;  // share of the diagonal by which a face on a cut is bent

}  // namespace

bool LeafShape::update(const Partition& partition, const Leaf& leaf, SectionPolygons& polygons, double diagonal) {
  cell = partition.planes_of(leaf.sides);
  const std::vector<int> nodes_before = std::exchange(nodes, polygons.corners_of(leaf));
  const std::size_t count_before = points.size();
  points = leaf.points;
  if (!leaf.dropped.empty())
    std::erase_if(nodes, [&](int node) {
      const Vec3& place = polygons.nodes()[static_cast<std::size_t>(node)].place;
      return std::any_of(leaf.dropped.begin(), leaf.dropped.end(),
                         [&](const Vec3& p) { return norm(p - place) <= kSameCorner * diagonal; });
    });
  for (const int node : nodes) points.push_back(polygons.nodes()[static_cast<std::size_t>(node)].place);
  if (points.size() < 4 || points.size() > SmallHull::kMaxPoints) return false;
  on_cut.assign(points.size(), 0);
  centre = {};
  for (const Vec3& p : points) centre += (1.0 / static_cast<double>(points.size())) * p;
  double radius = 0;
  for (const Vec3& p : points) radius = std::fmax(radius, norm(p - centre));
  bent = points;
  for (std::size_t v = leaf.points.size(); v < points.size(); ++v) {
    const Vec3 arm = points[v] - centre;
    const double height = kBulge * diagonal * (2 - dot(arm, arm) / (radius * radius));  // a paraboloid
    for (std::size_t s = 0; s < cell.size(); ++s)
      if (std::abs(cell[s].signed_distance(points[v])) <= kOnCut * diagonal) {
        bent[v] += height * cell[s].normal;
        on_cut[v] |= std::uint64_t{1} << (s % 64);
      }
  }
  return points.size() == count_before && nodes == nodes_before ? hull.follow(bent) : hull.build(bent);
}

std::vector<std::vector<int>> LeafShape::faces() const {
  std::vector<std::vector<int>> result;
  std::map<int, std::set<std::pair<int, int>>> edges;  // of the triangles on each cut
  for (const auto& triangle : hull.faces()) {
    const std::uint64_t cuts = common_cuts(triangle);
    if (cuts == 0)
      result.push_back({triangle.begin(), triangle.end()});
    else
      for (std::size_t k = 0; k < 3; ++k) edges[std::countr_zero(cuts)].emplace(triangle[k], triangle[(k + 1) % 3]);
  }
  for (const auto& [cut, directed] : edges) {
    std::map<int, int> next;  // along the boundary: edges met one way only
    for (const auto& [from, to] : directed)
      if (!directed.contains({to, from})) next[from] = to;
    std::vector<int> polygon;
    for (int v = next.begin()->first; polygon.size() < next.size(); v = next.at(v)) polygon.push_back(v);
    result.push_back(std::move(polygon));
  }
  return result;
}

double LeafShape::size() const {
  double size = 0;
  for (const Vec3& p : points)
    for (const Vec3& q : points) size = std::fmax(size, dot(p - q, p - q));
  return std::sqrt(size);
}

}  // namespace decomposition
