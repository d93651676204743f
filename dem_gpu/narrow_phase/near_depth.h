// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

struct LocalBall {
  LocalVec3 centre;
  LocalReal radius = 0;
};

/// About the middle of the points' bounding box. `Points` has blocks of eight: PartVertices or SurfacePieces.
template <class Points>
TALUS_HD LocalBall ball_about(const Points& points) {
  LaneVec3 low = points.block(0), high = low;
  for (int i = 1; i < points.block_count(); ++i) {
    const LaneVec3 p = points.block(i);
    low = {least(low.x, p.x), least(low.y, p.y), least(low.z, p.z)};
    high = {greatest(high.x, p.x), greatest(high.y, p.y), greatest(high.z, p.z)};
  }
  const LocalVec3 lowest{least_lane(low.x), least_lane(low.y), least_lane(low.z)};
  const LocalVec3 highest{greatest_lane(high.x), greatest_lane(high.y), greatest_lane(high.z)};
  return {LocalReal(0.5) * (lowest + highest), LocalReal(0.5) * norm(highest - lowest)};
}

/// Room for what of a depth field can be the least somewhere in an overlap.
struct NearField {
  static constexpr int kMostPlanes = 128, kMostTerms = 64;
  ScratchArray<LocalHalfSpace, kMostPlanes> plane;
  ScratchArray<DepthTerm, kMostTerms> term;
};

/// Depths of the shallowest and deepest of some points below a plane.
struct DepthRange {
  LocalReal shallowest, deepest;
};

template <class Points>
TALUS_HD DepthRange depth_range(const LocalHalfSpace& plane, const Points& points) {
  Lanes lowest = depths_below(plane, points.block(0)), highest = lowest;
  for (int i = 1; i < points.block_count(); ++i) {
    const Lanes depth = depths_below(plane, points.block(i));
    lowest = least(depth, lowest);
    highest = greatest(depth, highest);
  }
  return {least_lane(lowest), greatest_lane(highest)};
}

/// A term is the greatest of a few planes: in the hull of some points nowhere shallower and nowhere deeper than this.
/// `range_below`: of the points, below a plane.
template <class RangeBelow>
TALUS_HD DepthRange term_range(const DepthField& field, int term, RangeBelow&& range_below) {
  const LocalHalfSpace* planes = field.term_planes + field.terms[term].first;
  DepthRange range = range_below(planes[0]);
  for (int i = 1; i < field.terms[term].count; ++i) {
    const DepthRange other = range_below(planes[i]);
    range.shallowest = std::max(range.shallowest, other.shallowest);
    range.deepest = std::max(range.deepest, other.deepest);
  }
  return range;
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

/// The field in the hull of some points: a plane or term is out if it is nowhere there less deep than another one is at
/// its deepest. `ball` bounds the points and settles most at the cost of one depth. The whole field if too much is
/// near.
template <class Points>
TALUS_HD TALUS_DEVICE_CALL DepthField near_field(const DepthField& field, const Points& points, const LocalBall& ball,
                                                 NearField& near) {
  ScratchArray<LocalReal, NearField::kMostPlanes> plane_shallowest;
  ScratchArray<LocalReal, NearField::kMostTerms> term_shallowest;
  LocalReal bound = greatest_possible(ball, field);
  int planes = 0, terms = 0;
  const auto range_below = [&](const LocalHalfSpace& plane) { return depth_range(plane, points); };
  for (int i = 0; i < field.plane_count; ++i) {
    if (depth_below(field.planes[i], ball.centre) - ball.radius > bound) continue;
    const DepthRange range = range_below(field.planes[i]);
    bound = std::min(bound, range.deepest);
    if (range.shallowest > bound) continue;
    if (planes == NearField::kMostPlanes) return field;
    plane_shallowest[planes] = range.shallowest;
    near.plane[planes++] = field.planes[i];
  }
  for (int t = 0; t < field.term_count; ++t) {
    if (!is_within(field, t, ball, bound)) continue;
    const DepthRange range = term_range(field, t, range_below);
    bound = std::min(bound, range.deepest);
    if (range.shallowest > bound) continue;
    if (terms == NearField::kMostTerms) return field;
    term_shallowest[terms] = range.shallowest;
    near.term[terms++] = field.terms[t];
  }
  DepthField result = field;
  result.planes = near.plane.data();
  result.terms = near.term.data();
  result.plane_count = result.term_count = 0;
  for (int i = 0; i < planes; ++i)
    if (plane_shallowest[i] <= bound) near.plane[result.plane_count++] = near.plane[i];
  for (int t = 0; t < terms; ++t)
    if (term_shallowest[t] <= bound) near.term[result.term_count++] = near.term[t];
  return result;
}

}  // namespace dem_gpu
