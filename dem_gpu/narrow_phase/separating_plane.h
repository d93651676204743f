// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/face_mask.h"
#include "dem_gpu/narrow_phase/part_frame.h"

namespace dem_gpu {

/// The face plane that last separated two parts: face + 1 of a, or -(face + 1) of b; 0 for none. Contact of slow
/// bodies changes little in a step, so trying it first settles most separated pairs.
using SeparatingPlane = std::int16_t;

/// True if all vertices of `part` lie outside the plane, given in the frame that `to_plane` leads to.
TALUS_HD inline bool lies_outside(const PartView& part, const HalfSpace& plane, const FrameChange& to_plane) {
  // The plane in the part's own frame: one transformation instead of one per vertex.
  const Vec3 normal = to_plane.scale * transpose_times(to_plane.rotation, plane.normal);
  const Real offset = plane.offset - dot(plane.normal, to_plane.translation);
  for (int v = 0; v < part.range.vertex_count; ++v)
    if (dot(normal, part.vertices[v]) < offset) return false;
  return true;
}

/// Planes within this distance, over the size of the two parts, count as one: above the rounding of the frame changes,
/// far below any overlap that matters.
constexpr Real kCoplanarity = 1e-12;

/// Outcodes of vertices (in the solid's frame) against the planes of a convex solid; a vertex within `tolerance` of a
/// plane counts as inside. `coplanar`: planes with three vertices or more on them, which may hold a face of the other
/// part. Returns the face whose plane has all vertices outside, or -1.
TALUS_HD inline int classify(const PartView& solid, const Vec3* vertices, int vertex_count, Real tolerance,
                             FaceMask* outcode, FaceMask& coplanar) {
  for (int v = 0; v < vertex_count; ++v) outcode[v] = FaceMask{};
  for (int f = 0; f < solid.range.face_count; ++f) {
    const HalfSpace plane = solid.planes[f];
    bool all_outside = true;
    int on_plane = 0;
    for (int v = 0; v < vertex_count; ++v) {
      const Real height = dot(plane.normal, vertices[v]) - plane.offset;
      if (height < 0) all_outside = false;
      if (height > tolerance)
        outcode[v].insert(f);
      else if (height >= -tolerance)
        ++on_plane;
    }
    if (all_outside) return f;
    if (on_plane >= 3) coplanar.insert(f);
  }
  return -1;
}

}  // namespace dem_gpu
