// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "decomposition/geometry/small_hull.h"

namespace decomposition {
namespace {

constexpr int kMostPasses = 12;  // over all edges; more than that and building anew is as fast

}  // namespace

void SmallHull::measure_face(int face, const std::vector<Vec3>& points) {
  const auto f = static_cast<std::size_t>(face);
  const Vec3& a = points[static_cast<std::size_t>(faces_[f][0])];
  const Vec3 twice_area =
      cross(points[static_cast<std::size_t>(faces_[f][1])] - a, points[static_cast<std::size_t>(faces_[f][2])] - a);
  const double length = norm(twice_area);
  normals_[f] = length > 0 ? (1 / length) * twice_area : Vec3{};
  offsets_[f] = dot(normals_[f], a);
}

/// Normals and offsets of all faces; false if the polyhedron is not star-shaped about the middle of its points.
bool SmallHull::measure_faces(const std::vector<Vec3>& points) {
  middle_ = {};
  int corners = 0;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (is_vertex_[v]) middle_ += points[v], ++corners;
  middle_ = (1.0 / corners) * middle_;
  double nearest = 1;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    measure_face(static_cast<int>(f), points);
    nearest = std::min(nearest, offsets_[f] - dot(normals_[f], middle_));
  }
  return nearest > tolerance_;
}

void SmallHull::link_faces() {
  neighbours_.resize(faces_.size());
  for (auto& row : has_edge_) row.reset();
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces_[f][k], b = faces_[f][(k + 1) % 3];
      neighbours_[f][k] = edge_face(b, a);
      has_edge_[static_cast<std::size_t>(a)].set(static_cast<std::size_t>(b));
    }
  is_linked_ = true;
}

int SmallHull::edge_of(int face, int from) const {
  const auto& corners = faces_[static_cast<std::size_t>(face)];
  return corners[0] == from ? 0 : (corners[1] == from ? 1 : 2);
}

/// Makes two faces neighbours over the edge that starts at `from` in the one and at `other_from` in the other.
void SmallHull::link(int face, int from, int other, int other_from) {
  neighbours_[static_cast<std::size_t>(face)][static_cast<std::size_t>(edge_of(face, from))] =
      static_cast<std::int16_t>(other);
  neighbours_[static_cast<std::size_t>(other)][static_cast<std::size_t>(edge_of(other, other_from))] =
      static_cast<std::int16_t>(face);
}

/// Makes the re-entrant edge convex by adding the tetrahedron over it; false if that takes other flips first.
bool SmallHull::flip(int face, int edge, const std::vector<Vec3>& points) {
  const auto f = static_cast<std::size_t>(face), k = static_cast<std::size_t>(edge);
  const int next = neighbours_[f][k];
  const auto g = static_cast<std::size_t>(next);
  const int a = faces_[f][k], b = faces_[f][(k + 1) % 3], c = faces_[f][(k + 2) % 3];
  const auto m = static_cast<std::size_t>(edge_of(next, b));
  const int d = faces_[g][(m + 2) % 3];
  const int over_bc = neighbours_[f][(k + 1) % 3], over_ca = neighbours_[f][(k + 2) % 3];
  const int over_ad = neighbours_[g][(m + 1) % 3], over_db = neighbours_[g][(m + 2) % 3];
  if (over_ca == over_ad) return remove_corner(face, edge, next, points);
  if (over_bc == over_db) return remove_corner(next, static_cast<int>(m), face, points);
  if (has_edge_[static_cast<std::size_t>(c)].test(static_cast<std::size_t>(d))) return false;
  const auto at = [&](int v) -> const Vec3& { return points[static_cast<std::size_t>(v)]; };
  const auto sees_middle = [&](int u, int v, int w) {
    return dot(cross(at(v) - at(u), at(w) - at(u)), at(u) - middle_) <= 0;
  };
  if (sees_middle(a, d, c) || sees_middle(d, b, c)) return false;
  faces_[f] = {a, d, c};
  faces_[g] = {d, b, c};
  link(face, c, over_ca, a);
  link(face, a, over_ad, d);
  link(next, d, over_db, b);
  link(next, b, over_bc, c);
  link(face, d, next, c);
  has_edge_[static_cast<std::size_t>(a)].reset(static_cast<std::size_t>(b));
  has_edge_[static_cast<std::size_t>(b)].reset(static_cast<std::size_t>(a));
  has_edge_[static_cast<std::size_t>(c)].set(static_cast<std::size_t>(d));
  has_edge_[static_cast<std::size_t>(d)].set(static_cast<std::size_t>(c));
  measure_face(face, points);
  measure_face(next, points);
  return true;
}

/// Takes away the corner where the edge of the face starts: it has three faces only and fell inside.
bool SmallHull::remove_corner(int face, int edge, int next, const std::vector<Vec3>& points) {
  if (faces_.size() <= 4) return false;
  const auto f = static_cast<std::size_t>(face), k = static_cast<std::size_t>(edge);
  const int a = faces_[f][k], b = faces_[f][(k + 1) % 3], c = faces_[f][(k + 2) % 3];
  const int third = neighbours_[f][(k + 2) % 3];
  const int d = faces_[static_cast<std::size_t>(next)][(static_cast<std::size_t>(edge_of(next, b)) + 2) % 3];
  const int over_db = neighbours_[static_cast<std::size_t>(next)][static_cast<std::size_t>(edge_of(next, d))];
  const int over_cd = neighbours_[static_cast<std::size_t>(third)][static_cast<std::size_t>(edge_of(third, c))];
  const int over_bc = neighbours_[f][(k + 1) % 3];
  faces_[f] = {b, c, d};
  link(face, b, over_bc, c);
  link(face, c, over_cd, d);
  link(face, d, over_db, b);
  for (const int v : {b, c, d}) has_edge_[static_cast<std::size_t>(v)].reset(static_cast<std::size_t>(a));
  has_edge_[static_cast<std::size_t>(a)].reset();
  is_vertex_[static_cast<std::size_t>(a)] = 0;
  measure_face(face, points);
  // The last faces take the places of the two that are gone.
  for (const int gone : {std::max(next, third), std::min(next, third)}) {
    const auto last = faces_.size() - 1, hole = static_cast<std::size_t>(gone);
    if (hole != last) {
      faces_[hole] = faces_[last];
      normals_[hole] = normals_[last];
      offsets_[hole] = offsets_[last];
      for (std::size_t e = 0; e < 3; ++e) link(gone, faces_[hole][e], neighbours_[last][e], faces_[hole][(e + 1) % 3]);
    }
    faces_.pop_back();
    normals_.pop_back();
    offsets_.pop_back();
    neighbours_.pop_back();
  }
  return true;
}

bool SmallHull::flip_until_convex(const std::vector<Vec3>& points) {
  for (int pass = 0; pass < kMostPasses; ++pass) {
    bool is_convex = true, has_flipped = false;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto g = static_cast<std::size_t>(neighbours_[f][k]);
        if (g < f) continue;
        const int b = faces_[f][(k + 1) % 3];
        const int d = faces_[g][(static_cast<std::size_t>(edge_of(static_cast<int>(g), b)) + 2) % 3];
        if (dot(normals_[f], points[static_cast<std::size_t>(d)]) - offsets_[f] <= tolerance_) continue;
        is_convex = false;
        has_flipped |= flip(static_cast<int>(f), static_cast<int>(k), points);
        if (f >= faces_.size()) break;
      }
    if (is_convex) return true;
    if (!has_flipped) return false;
  }
  return false;
}

/// Whether a point that is no corner stands out.
bool SmallHull::stands_out(std::size_t v, const std::vector<Vec3>& points) const {
  if (is_vertex_[v]) return false;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (dot(normals_[f], points[v]) - offsets_[f] > tolerance_) return true;
  return false;
}

/// Takes in the points that stand out of a hull, as `build` does.
void SmallHull::insert_dead_points(const std::vector<Vec3>& points) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!stands_out(v, points)) continue;
    if (is_linked_) {
      for (std::size_t f = 0; f < faces_.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
          edge_face(faces_[f][k], faces_[f][(k + 1) % 3]) = static_cast<std::int16_t>(f);
      is_linked_ = false;
    }
    insert(static_cast<int>(v), points);
  }
}

bool SmallHull::follow(const std::vector<Vec3>& given) {
  if (faces_.empty() || given.size() != local_.size()) return build(given);
  for (std::size_t i = 0; i < given.size(); ++i) local_[i] = given[i] - given.front();
  if (!is_linked_) link_faces();
  if (!measure_faces(local_) || !flip_until_convex(local_)) return build(given);
  insert_dead_points(local_);
  return finish(local_) || build(given);
}

}  // namespace decomposition
