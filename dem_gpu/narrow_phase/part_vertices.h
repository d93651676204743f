// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Points, one array a coordinate, so that loops over them run in vector registers. Padded to whole blocks by repeating
/// the last point.
template <int kMost>
struct PointColumns {
  static_assert(kMost % kLanes == 0);

  ScratchArray<LocalReal, kMost> x, y, z;
  int count;         // of points
  int padded_count;  // a multiple of kLanes

  /// Heights of kLanes points from `first` over a plane.
  TALUS_HD Lanes height_over(const LocalHalfSpace& plane, int first) const {
    const LocalVec3& normal = plane.normal;
    return normal.x * load_lanes(x.data() + first) + normal.y * load_lanes(y.data() + first) +
           normal.z * load_lanes(z.data() + first) - plane.offset;
  }
  TALUS_HD LocalVec3 operator[](int i) const { return {x[i], y[i], z[i]}; }
  TALUS_HD void set(int i, const LocalVec3& point) {
    x[i] = point.x;
    y[i] = point.y;
    z[i] = point.z;
  }
  /// To be called when `count` points are set.
  TALUS_HD void pad() {
    padded_count = (count + kLanes - 1) / kLanes * kLanes;
    for (int i = count; i < padded_count; ++i) set(i, (*this)[count - 1]);
  }
};

/// Vertices of a part in another frame, where they are moved in Real and then rounded.
using PartVertices = PointColumns<kMaxPartVertices>;

TALUS_HD inline void transform_vertices(const PartView& part, const FrameChange& change, PartVertices& vertices) {
  vertices.count = part.range.vertex_count;
  for (int v = 0; v < vertices.count; ++v) vertices.set(v, rounded(change.point(part.vertices[v])));
  vertices.pad();
}

}  // namespace dem_gpu
