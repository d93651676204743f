// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "catalog/convex_part.h"
#include "dem_gpu/overlap_probe.h"
#include "tests/support/precision.h"

/// Overlap of two convex bodies in exact arithmetic: the reference for the engine's integrals.
///
/// Exact is this: a body is the convex hull of its vertices (doubles, as the engine stores them), turned by the exact
/// rotation of its quaternion (divided by its exact norm), scaled and shifted by doubles. Face planes follow from three
/// vertices, so faces must be exactly flat: triangles, or boxes. The engine rounds planes, rotation matrices and frame
/// changes; what that costs is part of its error here.
namespace exact {

struct Body {
  const catalog::ConvexPart& part;
  dem_gpu::BodyPose pose;
};

using test_support::kConditioned;

/// World axes; moments about a's position. Flush faces (see below) count as b's.
struct Overlap {
  double volume = 0;          // V [m3]
  dem_gpu::Vec3 area;         // S, vector area of a's surface inside b [m2]
  dem_gpu::Vec3 area_moment;  // M [m3]
  dem_gpu::Vec3 flush_area;   // vector area of the facets that lie in a face of each body [m2]
  double flush_volume = 0;    // at most, between these facets' two planes [m3]
  bool may_be_flush = false;  // rounding may tell otherwise of some faces whether they are flush
  double surface = 0;         // area of the overlap's whole surface [m2]
  /// Sum over the edges where a face of a meets one of b of length / sin(angle between the faces): how fast these edges
  /// move when a body moves [m]. Of nearly flush faces that cross near the overlap as well.
  double seam = 0;
  bool needed_exact = false;  // intervals of doubles were too wide

  /// What errors of V and S are measured by, where `size` is that of the bodies [m]: V and the surface themselves,
  /// unless a shift of the input by a share of the size changes them by more than kConditioned times that share (d(V)/V
  /// = size surface / V, d(S)/surface = size seam / surface): then what would be that sensitive.
  double volume_scale(double size) const { return std::max(volume, size * surface / kConditioned); }
  double area_scale(double size) const { return std::max(surface, size * seam / kConditioned); }
  bool is_well_conditioned(double size) const { return volume > 0 && volume_scale(size) <= volume; }
};

/// Faces with equal normals whose planes are nowhere further apart than `tolerance` within `reach` of `middle` are
/// flush [m]. Which body owns such a facet is a convention, so the engine's rule is part of the definition of S and M.
struct FlushRule {
  dem_gpu::Vec3 middle;  // from a's position, world axes
  double reach = 0, tolerance = 0;
};
Overlap overlap(const Body& a, const Body& b, const FlushRule& flush);

/// The same without the interval filter: for checking the filter.
Overlap overlap_unfiltered(const Body& a, const Body& b, const FlushRule& flush);

}  // namespace exact
