// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// Convex hull of a few points (at most kMaxPoints), made anew thousands of times in a fit, without allocation after
/// the first call. It expects points in general position; where rounding spoils the topology `build` says so.
class SmallHull {
 public:
  static constexpr int kMaxPoints = 128;

  /// Incremental, every point tested against every face. False if the points are flat or fewer than four, or more than
  /// kMaxPoints.
  bool build(const std::vector<Vec3>& points);
  /// The same for the points of the last call that have moved since, most of them a little: edges that are no longer
  /// convex are flipped (Gao, Cao, Tan & Huang 2013, star-shaped polyhedra), which where it works costs a fraction of
  /// `build`; where it does not, it builds.
  bool follow(const std::vector<Vec3>& points);

  /// n_faces x 3, counter-clockwise seen from outside, indices into the points given.
  const std::vector<std::array<int, 3>>& faces() const { return faces_; }
  bool is_vertex(int point) const { return is_vertex_[static_cast<std::size_t>(point)]; }
  int vertex_count() const { return vertex_count_; }
  double volume() const { return volume_; }

 private:
  bool start_with_tetrahedron(const std::vector<Vec3>& points, std::array<int, 4>& corners);
  void add_face(int a, int b, int c, const std::vector<Vec3>& points);
  void remove_face(int face);
  void insert(int point, const std::vector<Vec3>& points);
  bool find_horizon(const Vec3& p, double margin);
  bool horizon_is_a_loop();
  bool finish(const std::vector<Vec3>& points);
  bool measure_faces(const std::vector<Vec3>& points);
  void measure_face(int face, const std::vector<Vec3>& points);
  void link_faces();
  bool flip_until_convex(const std::vector<Vec3>& points);
  bool flip(int face, int edge, const std::vector<Vec3>& points);
  bool remove_corner(int face, int edge, int next, const std::vector<Vec3>& points);
  bool stands_out(std::size_t point, const std::vector<Vec3>& points) const;
  void insert_dead_points(const std::vector<Vec3>& points);
  int edge_of(int face, int from) const;
  void link(int face, int from, int other, int other_from);
  std::int16_t& edge_face(int a, int b) { return edge_face_[static_cast<std::size_t>(a * kMaxPoints + b)]; }

  std::vector<Vec3> local_;  // the points, seen from the first
  std::vector<std::array<int, 3>> faces_;
  std::vector<Vec3> normals_;                                                                 // unit, one per face
  std::vector<double> offsets_;                                                               // one per face
  std::vector<std::int16_t> edge_face_ = std::vector<std::int16_t>(kMaxPoints * kMaxPoints);  // face left of a -> b
  // Where the last hull can be followed: face across the edge from corner k to k + 1, and which corners have an edge.
  std::vector<std::array<std::int16_t, 3>> neighbours_;
  std::array<std::bitset<kMaxPoints>, kMaxPoints> has_edge_;
  bool is_linked_ = false;
  Vec3 middle_;
  std::vector<int> visible_;
  std::vector<char> is_visible_;
  std::vector<std::array<int, 2>> horizon_;
  std::array<int, kMaxPoints> next_{};  // along the horizon
  std::array<char, kMaxPoints> is_vertex_{};
  int vertex_count_ = 0;
  double volume_ = 0;
  double tolerance_ = 0;
};

/// Smallest extent of the points over the normals of the hull's faces.
double hull_thickness(const SmallHull& hull, const std::vector<Vec3>& points);

}  // namespace decomposition
