// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// The point of a simplex that is nearest to the origin, and the least part of the simplex that has it.
struct Simplex {
  static constexpr int kMost = 4;

  Vec3 point[kMost];
  int count = 0;

  TALUS_HD void add(const Vec3& x) { point[count++] = x; }

  /// Drops the points that are not needed. False if the origin is inside a simplex of four.
  TALUS_HD bool nearest(Vec3& x) {
    if (count == 1) {
      x = point[0];
      return true;
    }
    if (count == 2) {
      *this = of_edge(point[0], point[1], x);
      return true;
    }
    if (count == 3) {
      *this = of_triangle(point[0], point[1], point[2], x);
      return true;
    }
    const Simplex whole = *this;
    Real least = -1;
    for (int left_out = 0; left_out < kMost; ++left_out) {
      const auto corner = [&](int i) { return whole.point[(left_out + i) % kMost]; };
      const Vec3 normal = cross(corner(2) - corner(1), corner(3) - corner(1));
      // On the same side of the face as the point that it leaves out, the origin is not beyond it.
      if (dot(normal, corner(0) - corner(1)) * dot(normal, -corner(1)) > 0) continue;
      Vec3 on_face;
      const Simplex face = of_triangle(corner(1), corner(2), corner(3), on_face);
      if (least >= 0 && norm_squared(on_face) >= least) continue;
      least = norm_squared(on_face);
      x = on_face;
      *this = face;
    }
    return least >= 0;
  }

 private:
  TALUS_HD static Simplex of_point(const Vec3& a, Vec3& x) {
    Simplex result;
    result.add(a);
    x = a;
    return result;
  }
  TALUS_HD static Simplex of_edge(const Vec3& a, const Vec3& b, Vec3& x) {
    const Vec3 edge = b - a;
    const Real along = -dot(a, edge), square = norm_squared(edge);
    if (!(along > 0)) return of_point(a, x);
    if (along >= square) return of_point(b, x);
    Simplex result;
    result.add(a);
    result.add(b);
    x = a + (along / square) * edge;
    return result;
  }
  TALUS_HD static Simplex of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Vec3& x) {
    const Vec3 normal = cross(b - a, c - a);
    const Vec3* corner[3] = {&a, &b, &c};
    Simplex best;
    bool is_beyond_an_edge = false;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &p = *corner[i], &q = *corner[(i + 1) % 3];
      if (dot(cross(q - p, -p), normal) > 0) continue;
      Vec3 on_edge;
      const Simplex edge = of_edge(p, q, on_edge);
      if (is_beyond_an_edge && norm_squared(on_edge) >= norm_squared(x)) continue;
      is_beyond_an_edge = true;
      x = on_edge;
      best = edge;
    }
    if (is_beyond_an_edge) return best;
    best.add(a);
    best.add(b);
    best.add(c);
    x = (dot(a, normal) / norm_squared(normal)) * normal;
    return best;
  }
};

/// The one of some points that is farthest along a direction. `block(i)`: eight of them.
template <class Block>
TALUS_HD Vec3 farthest(const Vec3& direction, int block_count, const Block& block) {
  Real most = 0;
  Vec3 result;
  for (int i = 0; i < block_count; ++i) {
    const WideLaneVec3 points = widened(block(i));
    const WideLanes along = dot(direction, points);
    const Real largest = greatest_lane(along);
    if (i > 0 && largest <= most) continue;
    most = largest;
    const LaneSet below = lanes_above(every_lane<WideLanes>(largest), along);
    const int at = lowest_bit(~below);
    result = {points.x[at], points.y[at], points.z[at]};
  }
  return result;
}

/// How far apart two parts are at least, in a's unscaled frame [m]: between two planes across the line between their
/// nearest points, which the search may not have reached yet. 0 where they are not apart. Gilbert, Johnson & Keerthi,
/// IEEE J. Robot. Autom. 4 (1988) 193-203.
TALUS_HD TALUS_DEVICE_CALL inline Real distance_apart(const PartView& a, const PartView& b, const FrameChange& b_to_a) {
  constexpr int kMostSteps = 16;
  constexpr Real kGoodShare = Real(0.8);  // of the distance of the points found
  PartVertices vertices_b;
  transform_vertices(b, b_to_a, vertices_b);
  const int blocks_a = (a.range.vertex_count + kLanes - 1) / kLanes;
  const auto block_a = [&](int i) { return load_points(a.vertex_blocks[i]); };
  const auto block_b = [&](int i) { return vertices_b.block(i); };
  // The difference of the two, point by point, is a body whose point nearest to the origin tells the distance.
  Vec3 nearest = b_to_a.point(b.range.centre) - a.range.centre;
  Simplex simplex;
  Real distance = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Real length = norm(nearest);
    if (!(length > 0)) return 0;
    const Vec3 along = nearest / length;
    const Vec3 point = farthest(-along, vertices_b.block_count(), block_b) - farthest(along, blocks_a, block_a);
    distance = std::max(distance, dot(along, point));
    if (simplex.count > 0 && distance >= kGoodShare * length) return distance;
    simplex.add(point);
    if (!simplex.nearest(nearest)) return 0;
  }
  return distance;
}

}  // namespace dem_gpu
