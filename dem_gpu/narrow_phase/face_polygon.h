// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/core/vec3.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// Corners a clipped face may have: a face has at most kMaxFaceCorners, and each plane that cuts it adds at most one.
inline constexpr int kMaxPolygonCorners = 64;

/// A face of a part, cut down by a few planes, with all of its corners in one piece.
struct FacePolygon {
  ScratchArray<LocalVec3, kMaxPolygonCorners> corner;
  int count = 0;
  bool is_truncated = false;  // a corner did not fit: reported by the host, never dropped in silence
};

TALUS_HD inline void append(FacePolygon& polygon, const LocalVec3& corner) {
  if (polygon.count < kMaxPolygonCorners)
    polygon.corner[polygon.count++] = corner;
  else
    polygon.is_truncated = true;
}

/// Depth of each corner of a polygon below a plane.
using CornerDepths = ScratchArray<LocalReal, kMaxPolygonCorners>;

/// The piece of `polygon` where the depths, given at its corners and linear between them, are not negative. Sutherland
/// & Hodgman, Commun. ACM 17 (1974) 32-42.
TALUS_HD inline void clip(const FacePolygon& polygon, const CornerDepths& depths, FacePolygon& clipped) {
  clipped.count = 0;
  clipped.is_truncated = polygon.is_truncated;
  if (polygon.count == 0) return;
  LocalVec3 previous = polygon.corner[polygon.count - 1];
  LocalReal previous_depth = depths[polygon.count - 1];
  for (int c = 0; c < polygon.count; ++c) {
    const LocalVec3 current = polygon.corner[c];
    const LocalReal depth = depths[c];
    if ((depth > 0 && previous_depth < 0) || (depth < 0 && previous_depth > 0))
      append(clipped, previous + (previous_depth / (previous_depth - depth)) * (current - previous));
    if (depth >= 0) append(clipped, current);
    previous = current;
    previous_depth = depth;
  }
  if (clipped.count < 3) clipped.count = 0;
}

/// The piece of `polygon` inside the half-space (its normal need not be a unit vector).
TALUS_HD inline void clip(const FacePolygon& polygon, const LocalHalfSpace& half_space, FacePolygon& clipped) {
  CornerDepths depths;
  for (int c = 0; c < polygon.count; ++c) depths[c] = depth_below(half_space, polygon.corner[c]);
  clip(polygon, depths, clipped);
}

}  // namespace dem_gpu
