// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lane_vec3.h"
#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Eight points from each of the arrays of their coordinates.
TALUS_HD inline LaneVec3 load_points(const LocalReal* x, const LocalReal* y, const LocalReal* z) {
  return {load_lanes(x), load_lanes(y), load_lanes(z)};
}
TALUS_HD inline LaneVec3 load_points(const VertexBlock& block) { return load_points(block.x, block.y, block.z); }

/// Depths of points below a plane.
template <class SomeLanes, class Scalar>
TALUS_HD SomeLanes depths_below(const BasicHalfSpace<Scalar>& plane, const Vector3<SomeLanes>& points) {
  return plane.offset - dot(plane.normal, points);
}

/// Vertices of a part in another frame, where they are moved in Real and then rounded. Those beyond the last one, up to
/// a whole block, repeat it.
struct PartVertices {
  static_assert(kMaxPartVertices % kLanes == 0);

  alignas(64) ScratchArray<LocalReal, kMaxPartVertices> x, y, z;
  int count;

  /// All of them, as a set.
  TALUS_HD std::uint64_t all() const { return ~std::uint64_t{0} >> (64 - count); }
  TALUS_HD int block_count() const { return (count + kLanes - 1) / kLanes; }
  TALUS_HD LaneVec3 block(int i) const {
    return load_points(x.data() + i * kLanes, y.data() + i * kLanes, z.data() + i * kLanes);
  }
  /// Eight vertices by their numbers.
  TALUS_HD LaneVec3 at(const LaneOrder& order) const {
    if (count <= kLanes) return in_order(block(0), lane_index(order));
    if (count <= 2 * kLanes) {
      const LaneVec3 low = block(0), high = block(1);
      return {in_order(low.x, high.x, order), in_order(low.y, high.y, order), in_order(low.z, high.z, order)};
    }
    return {gathered(x.data(), order), gathered(y.data(), order), gathered(z.data(), order)};
  }
};

TALUS_HD inline WideLaneVec3 moved(const FrameChange& change, const WideLaneVec3& p) {
  const Mat3& r = change.rotation;
  const auto row = [&](Real a, Real b, Real c, Real shift) {
    return change.scale * (a * p.x + b * p.y + c * p.z) + shift;
  };
  return {row(r.column_x.x, r.column_y.x, r.column_z.x, change.translation.x),
          row(r.column_x.y, r.column_y.y, r.column_z.y, change.translation.y),
          row(r.column_x.z, r.column_y.z, r.column_z.z, change.translation.z)};
}

TALUS_HD TALUS_DEVICE_CALL inline void transform_vertices(const PartView& part, const FrameChange& change,
                                                          PartVertices& vertices) {
  vertices.count = part.range.vertex_count;
  for (int i = 0; i < vertices.block_count(); ++i) {
    const LaneVec3 points = rounded(moved(change, widened(load_points(part.vertex_blocks[i]))));
    store_lanes(points.x, vertices.x.data() + i * kLanes);
    store_lanes(points.y, vertices.y.data() + i * kLanes);
    store_lanes(points.z, vertices.z.data() + i * kLanes);
  }
}

}  // namespace dem_gpu
