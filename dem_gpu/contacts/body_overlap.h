// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem_gpu/narrow_phase/depth_integrals.h"
#include "dem_gpu/narrow_phase/parts_apart.h"
#include "dem_gpu/narrow_phase/volume_integrals.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// A law's integrals before any overlap, with the sums that friction asks for. `diameter`: equivalent, of the smaller
/// body [m].
template <class Sums = NoPatchSums>
TALUS_HD DepthIntegralsOf<LinearProfile, Sums> empty_integrals(const DepthPotential&, Real /*diameter*/,
                                                               Real /*scale_a*/, Real /*scale_b*/) {
  return {};
}
template <class Sums = NoPatchSums>
TALUS_HD VolumeIntegralsOf<Sums> empty_integrals(const OverlapVolume&, Real /*diameter*/, Real /*scale_a*/,
                                                 Real /*scale_b*/) {
  return {};
}
template <class Sums = NoPatchSums>
TALUS_HD DepthIntegralsOf<HardeningProfile, Sums> empty_integrals(const HardeningDepthPotential& law, Real diameter,
                                                                  Real scale_a, Real scale_b) {
  DepthIntegralsOf<HardeningProfile, Sums> integrals;
  integrals.profile_a.rate = rounded(scale_a / (law.hardening * diameter));
  integrals.profile_b.rate = rounded(scale_b / (law.hardening * diameter));
  return integrals;
}

TALUS_HD inline Real smaller_diameter(const ShapeView& shapes, int shape_a, int shape_b, const Pose& a, const Pose& b) {
  return std::min(a.scale * shapes.shapes[shape_a].equivalent_diameter,
                  b.scale * shapes.shapes[shape_b].equivalent_diameter);
}

/// Of a pair of bodies: whether no polygon was truncated, and how far they are apart at least, not above 0 if they may
/// touch [m].
struct PairOutcome {
  bool is_whole = true;
  Real distance = 0;
};

/// Rounding may have made a distance of two bodies larger than it is by a few units of the last place of their size [m
/// in a's unscaled frame].
TALUS_HD inline Real rounding_of_distance(const ShapeRange& a, const ShapeRange& b, const FrameChange& b_to_a) {
  constexpr Real kRounding = 10 * kCoplanarity;
  return kRounding * (a.bounding_radius + b_to_a.scale * b.bounding_radius);
}

/// Whether balls so far from each other that together reach so far are apart, and then how far [m].
TALUS_HD inline bool are_apart(const Vec3& between_centres, Real reach, Real& distance) {
  const Real square = norm_squared(between_centres);
  if (!(square >= reach * reach)) return false;
  distance = std::sqrt(square) - reach;
  return true;
}

/// Sums a law's integrals over all pairs of parts of two polyhedral bodies. `separating`: the contact's cache, one
/// entry per pair of parts.
template <class Integrals>
TALUS_HD PairOutcome integrate_bodies(const ShapeView& shapes, int shape_a, int shape_b, const Pose& a, const Pose& b,
                                      SeparatingPlane* separating, Integrals& integrals) {
  const ShapeRange& range_a = shapes.shapes[shape_a];
  const ShapeRange& range_b = shapes.shapes[shape_b];
  const BodyFrames bodies(a, b, range_a.bounding_radius, range_b.bounding_radius);
  const FrameChange& b_to_a = bodies.b_to_a;
  PairOutcome outcome;
  Real least = std::numeric_limits<Real>::max();  // distance of a pair of parts [m in a's unscaled frame]
  for (int j = 0; j < range_b.part_count; ++j) {
    const PartRange& ball_b = shapes.parts[range_b.first_part + j];
    const Vec3 centre_b = b_to_a.point(ball_b.centre);
    const Real radius_b = b_to_a.scale * ball_b.radius;
    Real distance = 0;
    if (are_apart(centre_b, radius_b + range_a.bounding_radius, distance)) {
      least = std::min(least, distance);
      continue;
    }
    for (int i = 0; i < range_a.part_count; ++i) {
      const PartRange& ball_a = shapes.parts[range_a.first_part + i];
      if (!are_apart(centre_b - ball_a.centre, radius_b + ball_a.radius, distance)) {
        const OverlapStatus status =
            integrate_overlap(part_view(shapes, range_a.first_part + i), part_view(shapes, range_b.first_part + j),
                              bodies, separating[i * range_b.part_count + j], integrals, distance);
        if (status == OverlapStatus::polygon_truncated) outcome.is_whole = false;
      }
      least = std::min(least, distance);
    }
  }
  outcome.distance = a.scale * (least - rounding_of_distance(range_a, range_b, b_to_a));
  return outcome;
}

/// How far apart two polyhedral bodies are at least [m]; not above 0 where they are not apart, or within rounding.
TALUS_HD TALUS_DEVICE_CALL inline Real distance_of_bodies(const ShapeView& shapes, int shape_a, int shape_b,
                                                          const Pose& a, const Pose& b) {
  const ShapeRange &range_a = shapes.shapes[shape_a], &range_b = shapes.shapes[shape_b];
  const FrameChange b_to_a = frame_change(a, b);
  Real least = std::numeric_limits<Real>::max();  // [m in a's unscaled frame]
  for (int j = 0; j < range_b.part_count; ++j) {
    const PartView part_b = part_view(shapes, range_b.first_part + j);
    const Vec3 centre_b = b_to_a.point(part_b.range.centre);
    for (int i = 0; i < range_a.part_count && least > 0; ++i) {
      const PartView part_a = part_view(shapes, range_a.first_part + i);
      const Real of_balls =
          norm(centre_b - part_a.range.centre) - (b_to_a.scale * part_b.range.radius + part_a.range.radius);
      if (of_balls < least) least = std::min(least, std::max(of_balls, distance_apart(part_a, part_b, b_to_a)));
    }
  }
  return a.scale * (least - rounding_of_distance(range_a, range_b, b_to_a));
}

}  // namespace dem_gpu
