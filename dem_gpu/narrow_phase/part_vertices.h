// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Vertices of a part in another frame (where they are moved in Real and then rounded), one array a coordinate, so that
/// loops over them run in vector registers. Padded to whole blocks by repeating the last vertex.
struct PartVertices {
  ScratchArray<LocalReal, kMaxPartVertices> x, y, z;
  int count;         // of vertices
  int padded_count;  // a multiple of kLanes

  /// Heights of kLanes vertices from `first` over a plane.
  TALUS_HD Lanes height_over(const LocalHalfSpace& plane, int first) const {
    const LocalVec3& normal = plane.normal;
    return normal.x * load_lanes(x.data() + first) + normal.y * load_lanes(y.data() + first) +
           normal.z * load_lanes(z.data() + first) - plane.offset;
  }
  TALUS_HD LocalVec3 operator[](int v) const { return {x[v], y[v], z[v]}; }
};
static_assert(kMaxPartVertices % kLanes == 0);

TALUS_HD inline void transform_vertices(const PartView& part, const FrameChange& change, PartVertices& vertices) {
  vertices.count = part.range.vertex_count;
  vertices.padded_count = (vertices.count + kLanes - 1) / kLanes * kLanes;
  for (int v = 0; v < vertices.padded_count; ++v) {
    const LocalVec3 point = rounded(change.point(part.vertices[v < vertices.count ? v : vertices.count - 1]));
    vertices.x[v] = point.x;
    vertices.y[v] = point.y;
    vertices.z[v] = point.z;
  }
}

}  // namespace dem_gpu
