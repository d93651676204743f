// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/part_frame.h"

namespace dem_gpu {

/// Signed distance from a point to a convex part (negative inside) and the outward direction there.
struct PartDistance {
  Real distance = 0;  // [m]
  Vec3 outward;       // unit, from the part's surface towards the point
};

/// Closest point of the segment from a to b.
TALUS_HD inline Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 edge = b - a;
  const Real share = dot(x - a, edge) / norm_squared(edge);
  return a + (share < 0 ? 0 : share > 1 ? 1 : share) * edge;
}

/// Distance in the part's own frame, looked for only within `reach`; farther points get a distance above `reach`.
/// Outside, the closest point lies on a face the point is in front of; inside, the shallowest outer face decides.
TALUS_HD inline PartDistance distance_to_part(const PartView& part, const Vec3& x, Real reach) {
  PartDistance result{2 * reach + 1, {0, 0, 1}};
  Real highest_outer = -1e300;
  int shallowest_outer = 0;
  bool is_outside = false;
  for (int f = 0; f < part.range.face_count; ++f) {
    const Real height = -depth_below<Real>(part.planes[f], x);
    if (height > reach) return {2 * reach + 1, part.planes[f].normal};
    if (height > 0) is_outside = true;
    if (f < part.range.outer_face_count && height > highest_outer) highest_outer = height, shallowest_outer = f;
  }
  if (!is_outside) {
    if (part.range.outer_face_count > 0) result = {highest_outer, part.planes[shallowest_outer].normal};
    return result;
  }
  Real best = 4 * (reach + 1) * (reach + 1);
  for (int f = 0; f < part.range.face_count; ++f) {
    const HalfSpace plane = part.planes[f];
    const Real height = dot(plane.normal, x) - plane.offset;
    if (height <= 0) continue;
    const FaceCorners face = part.faces[f];
    const std::uint8_t* corner = part.corners + face.first;
    Vec3 closest = x - height * plane.normal;
    bool is_in_face = true;
    Vec3 edge_point;
    Real edge_square = 1e300;
    for (int c = 0; c < face.count; ++c) {
      const Vec3 a = part.vertices[corner[c]], b = part.vertices[corner[(c + 1) % face.count]];
      if (dot(cross(b - a, closest - a), plane.normal) >= 0) continue;
      is_in_face = false;
      const Vec3 candidate = closest_on_segment(a, b, x);
      const Real square = norm_squared(x - candidate);
      if (square < edge_square) edge_square = square, edge_point = candidate;
    }
    if (!is_in_face) closest = edge_point;
    const Real square = norm_squared(x - closest);
    if (square < best) {
      best = square;
      const Real distance = std::sqrt(square);
      result = {distance, distance > 0 ? (x - closest) / distance : plane.normal};
    }
  }
  return result;
}

}  // namespace dem_gpu
