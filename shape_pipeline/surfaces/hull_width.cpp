// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/hull_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

/// An edge of the hull with the normals of its two faces: an arc on the sphere of directions.
struct HullEdge {
  Point from, along, left, right;

  double height() const { return normalized(add(left, right))[2]; }              // of the arc's middle
  double reach() const { return distance(normalized(add(left, right)), left); }  // from there to all of the arc
};

Point face_normal(const catalog::TriangleMesh& hull, const catalog::Triangle& face) {
  const Point& a = hull.vertices[face[0]];
  return normalized(cross(subtract(hull.vertices[face[1]], a), subtract(hull.vertices[face[2]], a)));
}

std::vector<HullEdge> hull_edges(const catalog::TriangleMesh& hull) {
  std::map<std::pair<int, int>, Point> half;
  std::vector<HullEdge> edges;
  for (const catalog::Triangle& face : hull.faces) {
    const Point normal = face_normal(hull, face);
    for (int c = 0; c < 3; ++c) {
      const int a = face[c], b = face[(c + 1) % 3];
      const auto other = half.find({b, a});
      if (other == half.end())
        half[{a, b}] = normal;
      else if (norm(cross(normal, other->second)) > 1e-9)  // else the two faces are one
        edges.push_back(
            {hull.vertices[a], normalized(subtract(hull.vertices[b], hull.vertices[a])), normal, other->second});
    }
  }
  return edges;
}

/// Whether the arc of one edge crosses the mirrored arc of the other: planes along both edges touch the hull there.
bool are_antipodal(const HullEdge& e, const HullEdge& f) {
  const double left = dot(f.along, e.left), right = dot(f.along, e.right);
  if (left * right > 0) return false;
  const double own_left = dot(e.along, f.left), own_right = dot(e.along, f.right);
  if (own_left * own_right > 0) return false;
  // The arcs' great circles cross at +-(along x along); both arcs must hold the same one, mirrored.
  const Point crossing = cross(e.along, f.along);
  const Point middle_e = add(e.left, e.right), middle_f = add(f.left, f.right);
  return dot(crossing, middle_e) * dot(crossing, middle_f) <= 0;
}

std::vector<std::vector<int>> neighbours_of(const catalog::TriangleMesh& hull) {
  std::vector<std::vector<int>> neighbours(hull.vertices.size());
  for (const catalog::Triangle& face : hull.faces)
    for (int c = 0; c < 3; ++c) neighbours[face[c]].push_back(face[(c + 1) % 3]);
  return neighbours;
}

double least_width_at_faces(const catalog::TriangleMesh& hull) {
  const std::vector<std::vector<int>> neighbours = neighbours_of(hull);
  double least = std::numeric_limits<double>::infinity();
  int farthest = hull.faces.front()[0];
  for (const catalog::Triangle& face : hull.faces) {
    const Point normal = face_normal(hull, face);
    if (norm(normal) == 0) continue;
    // On a convex surface climbing by neighbours ends at the farthest vertex; the last face's is near it. Heights along
    // the normal fall at each step, so that rounding cannot lead in a circle.
    double height = dot(normal, hull.vertices[farthest]);
    for (bool is_climbing = true; is_climbing;) {
      is_climbing = false;
      for (const int next : neighbours[farthest]) {
        const double lower = dot(normal, hull.vertices[next]);
        if (lower >= height) continue;
        height = lower;
        farthest = next;
        is_climbing = true;
        break;
      }
    }
    least = std::min(least, dot(normal, subtract(hull.vertices[face[0]], hull.vertices[farthest])));
  }
  return least;
}

double least_width_between_edges(const catalog::TriangleMesh& hull) {
  std::vector<std::pair<double, HullEdge>> edges;
  double longest_reach = 0;
  for (const HullEdge& edge : hull_edges(hull)) {
    edges.emplace_back(edge.height(), edge);
    longest_reach = std::max(longest_reach, edge.reach());
  }
  const auto is_lower = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(edges.begin(), edges.end(), is_lower);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [height, edge] : edges) {
    const double slack = edge.reach() + longest_reach;
    for (auto other = std::lower_bound(edges.begin(), edges.end(), std::pair(-height - slack, edge), is_lower);
         other != edges.end() && other->first <= -height + slack; ++other) {
      if (!are_antipodal(edge, other->second)) continue;
      const Point across = cross(edge.along, other->second.along);
      if (norm(across) < 1e-9) continue;  // parallel edges: a face's width is as small
      least = std::min(least, std::abs(dot(normalized(across), subtract(edge.from, other->second.from))));
    }
  }
  return least;
}

}  // namespace

double least_width(const catalog::TriangleMesh& hull) {
  return std::min(least_width_at_faces(hull), least_width_between_edges(hull));
}

}  // namespace shape_pipeline
