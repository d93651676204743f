// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/bounds.h"

#include <algorithm>
#include <limits>
#include <set>

#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/leaf_shape.h"
#include "decomposition/fit/part_fit.h"
#include "decomposition/geometry/convex_polygon.h"
#include "decomposition/geometry/faceted_hull.h"

namespace decomposition {
namespace {

constexpr double kLeastWeight = 0.05;  // of a face's corner in the motion of the face
constexpr double kOnCut = 1e-8;        // share of the diagonal: nearer points lie on the cut
constexpr double kAlongWall = 1e-4;    // slope of an edge that runs along an earlier cut
constexpr double kFlattest = 0.25;  // square of the sine between a face and a cut, below which more pushing is no use

/// A wish to move.
struct Wish {
  Vec3 sum;
  int count = 0;

  void add(const Vec3& motion) { sum += motion, ++count; }
  Vec3 mean() const { return count > 0 ? (1.0 / count) * sum : Vec3{}; }
};

/// Weights of the corners of a triangle at the place nearest to p, none too small; they add up to 1.
std::array<double, 3> weights_at(const std::array<Vec3, 3>& corner, const Vec3& normal, const Vec3& p) {
  std::array<double, 3> weight;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = dot(normal, cross(corner[(k + 2) % 3] - corner[(k + 1) % 3], p - corner[(k + 1) % 3]));
    weight[k] = part;
    sum += part;
  }
  double total = 0;
  for (double& w : weight) total += w = std::clamp(sum > 0 ? w / sum : 1 / 3.0, kLeastWeight, 1.0);
  for (double& w : weight) w /= total;
  return weight;
}

/// Outer triangles of a leaf with what they breach.
struct Breach {
  std::array<int, 3> triangle;
  Vec3 normal;
  double depth;  // to be moved outward (or inward) by this
  Vec3 place;
};

std::vector<Breach> outer_triangles(const LeafShape& shape) {
  std::vector<Breach> result;
  for (const auto& triangle : shape.hull.faces()) {
    if (shape.is_on_one_cut(triangle)) continue;
    const auto at = [&](std::size_t k) { return shape.points[static_cast<std::size_t>(triangle[k])]; };
    const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    if (norm(normal) > 0)
      result.push_back({triangle, normalized(normal), -std::numeric_limits<double>::infinity(), {}});
  }
  return result;
}

/// How far points stand out of each outer triangle's plane.
void find_outside(const LeafShape& shape, const std::vector<Vec3>& points, std::vector<Breach>& breaches) {
  for (Breach& breach : breaches) {
    const double offset = dot(breach.normal, shape.points[static_cast<std::size_t>(breach.triangle[0])]);
    for (const Vec3& p : points)
      if (const double depth = dot(breach.normal, p) - offset; depth > breach.depth)
        breach.depth = depth, breach.place = p;
  }
}

/// How deep points lie under the outer triangle that is nearest to each.
void find_inside(const LeafShape& shape, const std::vector<Vec3>& points, std::vector<Breach>& breaches) {
  for (const Vec3& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    Breach* triangle = nullptr;
    for (Breach& breach : breaches) {
      const double depth = dot(breach.normal, shape.points[static_cast<std::size_t>(breach.triangle[0])] - p);
      if (depth < nearest) nearest = depth, triangle = &breach;
      if (nearest < 0) break;
    }
    if (triangle && nearest > triangle->depth) triangle->depth = nearest, triangle->place = p;
  }
}

/// Adds the polygon's points that lie behind all planes.
void add_clipped(const std::vector<Vec3>& triangle, const std::vector<Plane>& cell, std::vector<Vec3>& points) {
  for (const Plane& plane : cell)
    if (std::all_of(triangle.begin(), triangle.end(), [&](const Vec3& p) { return plane.signed_distance(p) > 0; }))
      return;
  const std::vector<Vec3> kept = clip(triangle, cell);
  points.insert(points.end(), kept.begin(), kept.end());
}

/// Corners of the convex hull; all points if they are flat.
std::vector<Vec3> hull_corners(std::vector<Vec3> points) {
  std::set<int> corners;
  if (points.size() > 4)
    for (const auto& triangle : hull_triangles(points)) corners.insert(triangle.begin(), triangle.end());
  if (corners.empty()) return points;
  std::vector<Vec3> hull;
  for (const int v : corners) hull.push_back(points[static_cast<std::size_t>(v)]);
  return hull;
}

/// Wishes for the corners of a section whose outer edges break the bound; returns the largest breach.
double push_section(const Partition& partition, const SectionPolygons& polygons, int section, Bound bound,
                    const std::vector<Vec3>& points, double slack, double eagerness, std::vector<Wish>& wishes) {
  const std::vector<int>& polygon = polygons.polygon(section);
  const Vec3& normal = partition.cut_of(partition.sections[static_cast<std::size_t>(section)]).plane.normal;
  struct Edge {
    std::size_t from, to;
    Vec3 outward;
    double depth = -std::numeric_limits<double>::infinity();
    Vec3 place{};
  };
  std::vector<Edge> edges;
  const auto node = [&](std::size_t n) -> const SectionNode& { return polygons.nodes()[n]; };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto from = static_cast<std::size_t>(polygon[k]);
    const auto to = static_cast<std::size_t>(polygon[(k + 1) % polygon.size()]);
    // Between two derived nodes on one earlier cut the polygon ends at that cut.
    if (!node(from).is_free() && !node(to).is_free()) {
      const bool is_wall = std::any_of(
          partition.sections[static_cast<std::size_t>(section)].walls.begin(),
          partition.sections[static_cast<std::size_t>(section)].walls.end(), [&](int wall) {
            const Plane& plane = partition.cut_of(partition.sections[static_cast<std::size_t>(wall)]).plane;
            const double length = norm(node(to).place - node(from).place);
            return std::abs(plane.signed_distance(node(from).place)) + std::abs(plane.signed_distance(node(to).place)) <
                   kAlongWall * length;
          });
      if (is_wall) continue;
    }
    const Vec3 outward = cross(node(to).place - node(from).place, normal);
    if (norm(outward) > 0) edges.push_back({from, to, normalized(outward)});
  }
  for (const Vec3& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    Edge* below = nullptr;
    for (Edge& edge : edges) {
      const double depth = dot(edge.outward, p - node(edge.from).place);
      if (bound == Bound::holds_solid && depth > edge.depth) edge.depth = depth, edge.place = p;
      if (-depth < nearest) nearest = -depth, below = &edge;
    }
    if (bound == Bound::stays_inside && below && nearest > below->depth) below->depth = nearest, below->place = p;
  }
  double worst = -std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges) {
    worst = std::fmax(worst, edge.depth);
    if (edge.depth <= -slack) continue;
    const Vec3 along = node(edge.to).place - node(edge.from).place;
    const double t =
        std::clamp(dot(edge.place - node(edge.from).place, along) / dot(along, along), kLeastWeight, 1 - kLeastWeight);
    const double squares = t * t + (1 - t) * (1 - t);
    const double motion = (bound == Bound::holds_solid ? 1 : -1) * eagerness * (edge.depth + slack) / squares;
    wishes[edge.from].add(((1 - t) * motion) * edge.outward);
    wishes[edge.to].add((t * motion) * edge.outward);
  }
  return worst;
}

}  // namespace

BoundPoints bound_points(const Solid& solid, const Partition& partition, bool hulls_only) {
  BoundPoints result;
  result.on_section.resize(partition.sections.size());
  for (const Leaf& leaf : partition.leaves) {
    const std::vector<Plane> cell = partition.planes_of(leaf.sides);
    std::vector<Vec3> points;
    for (const catalog::Triangle& face : solid.faces()) {
      std::vector<Vec3> triangle;
      for (const int v : face) triangle.push_back(solid.vertices()[static_cast<std::size_t>(v)]);
      add_clipped(triangle, cell, points);
    }
    if (hulls_only) points = hull_corners(std::move(points));
    result.in_cell.emplace_back();
    for (const Vec3& p : points) {
      bool is_on_cut = false;
      for (const int section : leaf.sections) {
        const Plane& plane = partition.cut_of(partition.sections[static_cast<std::size_t>(section)]).plane;
        if (std::abs(plane.signed_distance(p)) > kOnCut * solid.diagonal()) continue;
        is_on_cut = true;
        result.on_section[static_cast<std::size_t>(section)].push_back(p);
      }
      if (!is_on_cut) result.in_cell.back().push_back(p);
    }
  }
  return result;
}

int add_points_inside(const Solid& solid, const Partition& partition, double tolerance, BoundPoints& points) {
  SectionPolygons polygons;
  polygons.build(partition, kSameCorner * solid.diagonal());
  int added = 0;
  for (std::size_t a = 0; a < partition.leaves.size(); ++a) {
    LeafShape shape;
    if (!shape.update(partition, partition.leaves[a], polygons, solid.diagonal())) continue;
    std::vector<Plane> within = shape.cell;
    for (const Breach& outer : outer_triangles(shape)) {
      const Vec3& p = shape.points[static_cast<std::size_t>(outer.triangle[0])];
      within.push_back({outer.normal, dot(outer.normal, p) - tolerance});
    }
    for (const catalog::Triangle& face : solid.faces()) {
      std::vector<Vec3> triangle, piece;
      for (const int v : face) triangle.push_back(solid.vertices()[static_cast<std::size_t>(v)]);
      add_clipped(triangle, within, piece);
      if (piece.empty()) continue;
      Vec3 middle;
      for (const Vec3& p : piece) middle += (1.0 / static_cast<double>(piece.size())) * p;
      points.in_cell[a].push_back(middle);
      ++added;
    }
  }
  return added;
}

double push_towards_bound(const Solid& solid, Partition& partition, Bound bound, const BoundPoints& points,
                          double slack, double eagerness) {
  SectionPolygons polygons;
  polygons.build(partition, kSameCorner * solid.diagonal());
  std::vector<LeafShape> shapes(partition.leaves.size());
  for (std::size_t a = 0; a < shapes.size(); ++a)
    if (!shapes[a].update(partition, partition.leaves[a], polygons, solid.diagonal()))
      return std::numeric_limits<double>::infinity();
  const std::vector<SectionNode>& nodes = polygons.nodes();
  std::vector<Wish> node_wishes(nodes.size());
  const double sign = bound == Bound::holds_solid ? 1 : -1;
  double worst = -std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < shapes.size(); ++a) {
    const LeafShape& shape = shapes[a];
    std::vector<Breach> breaches = outer_triangles(shape);
    if (bound == Bound::holds_solid)
      find_outside(shape, points.in_cell[a], breaches);
    else
      find_inside(shape, points.in_cell[a], breaches);
    std::vector<Wish> wishes(shape.own_count());
    for (const Breach& breach : breaches) {
      worst = std::fmax(worst, breach.depth);
      if (breach.depth <= -slack) continue;
      std::array<Vec3, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = shape.points[static_cast<std::size_t>(breach.triangle[k])];
      const std::array<double, 3> weight = weights_at(corner, breach.normal, breach.place);
      const double squares = weight[0] * weight[0] + weight[1] * weight[1] + weight[2] * weight[2];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 motion = (sign * eagerness * (breach.depth + slack) * weight[k] / squares) * breach.normal;
        const auto v = static_cast<std::size_t>(breach.triangle[k]);
        if (v < wishes.size())
          wishes[v].add(motion);
        else
          node_wishes[static_cast<std::size_t>(shape.nodes[v - wishes.size()])].add(motion);
      }
    }
    for (std::size_t v = 0; v < wishes.size(); ++v)
      if (wishes[v].count > 0)
        partition.leaves[a].points[v] = project_into_cell(partition.leaves[a].points[v] + wishes[v].mean(), shape.cell,
                                                          shape.centre, 0.5 * kOwnMargin * solid.diagonal());
  }
  for (std::size_t s = 0; s < partition.sections.size(); ++s)
    worst = std::fmax(worst, push_section(partition, polygons, static_cast<int>(s), bound, points.on_section[s], slack,
                                          eagerness, node_wishes));
  for (std::size_t n = nodes.size(); n-- > 0;) {
    const SectionNode& node = nodes[n];
    if (node_wishes[n].count == 0) continue;
    Vec3 motion = node_wishes[n].mean();
    if (!node.is_free()) {
      const double rest = 1 - node.share, squares = rest * rest + node.share * node.share;
      node_wishes[static_cast<std::size_t>(node.from)].add((rest / squares) * motion);
      node_wishes[static_cast<std::size_t>(node.to)].add((node.share / squares) * motion);
      continue;
    }
    Section& section = partition.sections[static_cast<std::size_t>(node.section)];
    const Vec3& normal = partition.cut_of(section).plane.normal;
    const double length = norm(motion);
    if (length == 0) continue;
    const double along = dot(motion, normal) / length;
    motion -= dot(motion, normal) * normal;  // in the cut; as far as that takes the face as far
    section.corners[static_cast<std::size_t>(node.corner)] += (1 / std::fmax(kFlattest, 1 - along * along)) * motion;
  }
  return worst;
}

}  // namespace decomposition
