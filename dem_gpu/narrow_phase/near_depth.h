// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// What of a solid's depth field can be the least somewhere in its overlap with the hull of some vertices: a plane is
/// out if all vertices lie deeper below it than the deepest lies below another.
struct NearDepth {
  static constexpr int kMostPlanes = 128;
  ScratchArray<LocalHalfSpace, kMostPlanes> plane;
  int plane_count;
  int term_count;  // all of the solid's, or none if none is near
  bool is_truncated;
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

/// True if no plane of the term is deeper than `bound` all over a ball.
TALUS_HD inline bool is_within(const DepthField& field, int term, const LocalVec3& centre, LocalReal radius,
                               LocalReal bound) {
  const LocalHalfSpace* planes = field.term_planes + field.terms[term].first;
  for (int i = 0; i < field.terms[term].count; ++i)
    if (depth_below(planes[i], centre) - radius > bound) return false;
  return true;
}

/// `centre`, `radius`: bounding sphere of the vertices, which settles the planes on the solid's far side.
TALUS_HD inline void find_near_depth(const DepthField& field, const PartVertices& vertices, const LocalVec3& centre,
                                     LocalReal radius, NearDepth& near) {
  ScratchArray<LocalReal, NearDepth::kMostPlanes> shallowest;
  ScratchArray<std::int16_t, NearDepth::kMostPlanes> candidate;
  near.plane_count = near.term_count = 0;
  near.is_truncated = false;
  int nearest = 0;
  LocalReal nearest_depth = std::numeric_limits<LocalReal>::max();
  for (int i = 0; i < field.plane_count; ++i) {
    const Real depth = depth_below(field.planes[i], centre);
    if (depth < nearest_depth) nearest_depth = depth, nearest = i;
  }
  LocalReal bound = depth_range(field.planes[nearest], vertices).deepest;
  int candidate_count = 0;
  for (int i = 0; i < field.plane_count; ++i) {
    const LocalHalfSpace plane = field.planes[i];
    if (depth_below(plane, centre) - radius > bound) continue;
    const DepthRange range = depth_range(plane, vertices);
    if (range.deepest < bound) bound = range.deepest;
    if (range.shallowest > bound) continue;
    if (candidate_count == NearDepth::kMostPlanes) {
      near.is_truncated = true;
      return;
    }
    shallowest[candidate_count] = range.shallowest;
    candidate[candidate_count++] = static_cast<std::int16_t>(i);
  }
  for (int k = 0; k < candidate_count; ++k)
    if (shallowest[k] <= bound) near.plane[near.plane_count++] = field.planes[candidate[k]];
  for (int t = 0; t < field.term_count && near.term_count == 0; ++t)
    if (is_within(field, t, centre, radius, bound)) near.term_count = field.term_count;
}

}  // namespace dem_gpu
