// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// What of a solid's depth field can be the least somewhere in its overlap with the hull of some vertices: a plane or
/// term is out if all vertices lie deeper below it than the deepest lies below another.
struct NearDepth {
  static constexpr int kMostPlanes = 128, kMostTerms = 64, kMostTermPlanes = 256;
  ScratchArray<HalfSpace, kMostPlanes> plane;
  int plane_count;
  ScratchArray<DepthTerm, kMostTerms> term;
  int term_count;
  ScratchArray<HalfSpace, kMostTermPlanes> term_plane;
  bool is_truncated;

  TALUS_HD DepthField field() const { return {plane.data(), plane_count, term.data(), term_count, term_plane.data()}; }
};

/// Depths of the shallowest and deepest vertex below a plane, or bounds of them below a term.
struct DepthRange {
  Real shallowest, deepest;
};

TALUS_HD inline DepthRange depth_range(const HalfSpace& plane, const PartVertices& vertices) {
  Lanes lowest = vertices.height_over(plane, 0), highest = lowest;
  for (int first = kLanes; first < vertices.padded_count; first += kLanes) {
    const Lanes height = vertices.height_over(plane, first);
    lowest = least(height, lowest);
    highest = greatest(height, highest);
  }
  return {-greatest_lane(highest), -least_lane(lowest)};
}

/// Adds the terms that can be the least below `bound`, without the planes that another of their planes outdoes at all
/// vertices; a term left with one plane becomes a plane.
TALUS_HD inline void add_near_terms(const DepthField& field, const PartVertices& vertices, const Vec3& centre,
                                    Real radius, Real bound, NearDepth& near) {
  int used = 0;
  for (int t = 0; t < field.term_count; ++t) {
    const HalfSpace* planes = field.term_planes + field.terms[t].first;
    const int count = field.terms[t].count;
    bool is_far = false;
    for (int i = 0; i < count && !is_far; ++i) is_far = depth_below(planes[i], centre) - radius > bound;
    if (is_far) continue;
    if (near.term_count == NearDepth::kMostTerms || used + count > NearDepth::kMostTermPlanes ||
        near.plane_count == NearDepth::kMostPlanes) {
      near.is_truncated = true;
      return;
    }
    ScratchArray<Real, NearDepth::kMostTermPlanes> deepest;
    Real shallowest = -std::numeric_limits<Real>::max();
    int first = 0;
    for (int i = 0; i < count; ++i) {
      const DepthRange range = depth_range(planes[i], vertices);
      deepest[i] = range.deepest;
      if (range.shallowest > shallowest) shallowest = range.shallowest, first = i;
    }
    if (shallowest > bound) continue;
    int kept = 0;
    for (int i = 0; i < count; ++i)
      if (i == first || deepest[i] > shallowest) near.term_plane[used + kept++] = planes[i];
    if (kept == 1) {
      near.plane[near.plane_count++] = near.term_plane[used];
    } else {
      near.term[near.term_count++] = {used, kept};
      used += kept;
    }
  }
}

/// `centre`, `radius`: bounding sphere of the vertices, which settles the planes on the solid's far side.
TALUS_HD inline void find_near_depth(const DepthField& field, const PartVertices& vertices, const Vec3& centre,
                                     Real radius, NearDepth& near) {
  ScratchArray<Real, NearDepth::kMostPlanes> shallowest;
  ScratchArray<std::int16_t, NearDepth::kMostPlanes> candidate;
  near.plane_count = near.term_count = 0;
  near.is_truncated = false;
  int nearest = 0;
  Real nearest_depth = std::numeric_limits<Real>::max();
  for (int i = 0; i < field.plane_count; ++i) {
    const Real depth = depth_below(field.planes[i], centre);
    if (depth < nearest_depth) nearest_depth = depth, nearest = i;
  }
  Real bound = depth_range(field.planes[nearest], vertices).deepest;
  int candidate_count = 0;
  for (int i = 0; i < field.plane_count; ++i) {
    const HalfSpace plane = field.planes[i];
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
  if (field.term_count > 0) add_near_terms(field, vertices, centre, radius, bound, near);
}

}  // namespace dem_gpu
