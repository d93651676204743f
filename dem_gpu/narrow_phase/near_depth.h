// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/part_vertices.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

struct LocalBall {
  LocalVec3 centre;
  LocalReal radius = 0;
};

/// Bounds of pieces of a surface.
class PieceBounds {
 public:
  TALUS_HD void add(const Polygon& piece) {
    for (int c = 0; c < piece.count; ++c) {
      const LocalVec3& p = piece.corner[c];
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
  }
  TALUS_HD bool is_empty() const { return low_.x > high_.x; }
  TALUS_HD LocalBall ball() const { return {LocalReal(0.5) * (low_ + high_), LocalReal(0.5) * norm(high_ - low_)}; }

 private:
  static constexpr LocalReal kFar = std::numeric_limits<LocalReal>::max();
  LocalVec3 low_{kFar, kFar, kFar}, high_{-kFar, -kFar, -kFar};
};

/// Room for the planes of a depth field that can be the least somewhere in an overlap.
struct NearPlanes {
  static constexpr int kMost = 128;
  ScratchArray<LocalHalfSpace, kMost> plane;
};

/// Depths of the shallowest and deepest vertex below a plane.
struct DepthRange {
  LocalReal shallowest, deepest;
};

TALUS_HD inline DepthRange depth_range(const LocalHalfSpace& plane, const PartVertices& vertices) {
  Lanes lowest = vertices.height_over(plane, 0), highest = lowest;
  for (int first = kLanes; first < vertices.padded_count; first += kLanes) {
    const Lanes height = vertices.height_over(plane, first);
    lowest = least(height, lowest);
    highest = greatest(height, highest);
  }
  return {-greatest_lane(highest), -least_lane(lowest)};
}

/// Deeper than this the field is nowhere in the ball: every depth changes by at most the distance.
TALUS_HD inline LocalReal greatest_possible(const LocalBall& ball, const DepthField& field) {
  LocalReal limit = std::numeric_limits<LocalReal>::max();
  for (int i = 0; i < field.plane_count; ++i) limit = std::min(limit, depth_below(field.planes[i], ball.centre));
  for (int t = 0; t < field.term_count; ++t) {
    const LocalHalfSpace* planes = field.term_planes + field.terms[t].first;
    LocalReal depth = depth_below(planes[0], ball.centre);
    for (int i = 1; i < field.terms[t].count && depth < limit; ++i)
      depth = std::max(depth, depth_below(planes[i], ball.centre));
    limit = std::min(limit, depth);
  }
  return limit + ball.radius;
}

/// True if no plane of the term is deeper than `bound` all over a ball.
TALUS_HD inline bool is_within(const DepthField& field, int term, const LocalBall& ball, LocalReal bound) {
  const LocalHalfSpace* planes = field.term_planes + field.terms[term].first;
  for (int i = 0; i < field.terms[term].count; ++i)
    if (depth_below(planes[i], ball.centre) - ball.radius > bound) return false;
  return true;
}

/// The field with all its terms, or with none if none is near.
TALUS_HD inline DepthField with_planes(const DepthField& field, const LocalHalfSpace* planes, int plane_count,
                                       const LocalBall& ball, LocalReal bound) {
  DepthField near = field;
  near.planes = planes;
  near.plane_count = plane_count;
  near.term_count = 0;
  for (int t = 0; t < field.term_count && near.term_count == 0; ++t)
    if (is_within(field, t, ball, bound)) near.term_count = field.term_count;
  return near;
}

/// The field in the hull of some vertices, for a field of at most NearPlanes::kMost planes: a plane is out if all
/// vertices lie deeper below it than the deepest lies below another. `ball` bounds the vertices and settles the planes
/// on the solid's far side.
TALUS_HD inline DepthField near_hull(const DepthField& field, const PartVertices& vertices, const LocalBall& ball,
                                     NearPlanes& near) {
  ScratchArray<LocalReal, NearPlanes::kMost> shallowest;
  ScratchArray<std::int16_t, NearPlanes::kMost> candidate;
  int nearest = 0;
  LocalReal nearest_depth = std::numeric_limits<LocalReal>::max();
  for (int i = 0; i < field.plane_count; ++i) {
    const LocalReal depth = depth_below(field.planes[i], ball.centre);
    if (depth < nearest_depth) nearest_depth = depth, nearest = i;
  }
  LocalReal bound = depth_range(field.planes[nearest], vertices).deepest;
  int candidate_count = 0;
  for (int i = 0; i < field.plane_count; ++i) {
    const LocalHalfSpace plane = field.planes[i];
    if (depth_below(plane, ball.centre) - ball.radius > bound) continue;
    const DepthRange range = depth_range(plane, vertices);
    if (range.deepest < bound) bound = range.deepest;
    if (range.shallowest > bound) continue;
    shallowest[candidate_count] = range.shallowest;
    candidate[candidate_count++] = static_cast<std::int16_t>(i);
  }
  int plane_count = 0;
  for (int k = 0; k < candidate_count; ++k)
    if (shallowest[k] <= bound) near.plane[plane_count++] = field.planes[candidate[k]];
  return with_planes(field, near.plane.data(), plane_count, ball, bound);
}

/// The field in a ball; the whole field if too many planes are near.
TALUS_HD inline DepthField near_ball(const DepthField& field, const LocalBall& ball, NearPlanes& near) {
  const LocalReal bound = greatest_possible(ball, field);
  int plane_count = 0;
  for (int i = 0; i < field.plane_count; ++i) {
    if (depth_below(field.planes[i], ball.centre) - ball.radius > bound) continue;
    if (plane_count == NearPlanes::kMost) return field;
    near.plane[plane_count++] = field.planes[i];
  }
  return with_planes(field, near.plane.data(), plane_count, ball, bound);
}

}  // namespace dem_gpu
