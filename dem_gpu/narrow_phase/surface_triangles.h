// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/scratch_array.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// Triangles of the pieces of one part's surface inside another, end to end: a piece has two or three, so that those of
/// several fill a register. Corners anticlockwise as seen from outside.
class SurfaceTriangles {
 public:
  static constexpr int kMost = 64;

  TALUS_HD bool is_empty() const { return count_ == 0; }
  TALUS_HD void clear() { count_ = 0; }

  /// Adds the fan of a polygon; false if there is no room.
  TALUS_HD TALUS_INLINE bool add(const Polygon& polygon, bool is_outer) {
    const int more = polygon.count - 2;
    if (count_ + more > kMost) return false;
    store(polygon.corners, is_outer ? LocalReal(1) : LocalReal(0));
    count_ += more > 0 ? more : 0;
    return true;
  }

  /// Fills the last eight up with triangles without area.
  TALUS_HD TALUS_INLINE void fill_up() {
    const LocalVec3 corner = point(0);
    const auto everywhere = [](LocalReal x) { return every_lane<Lanes>(x); };
    store({everywhere(corner.x), everywhere(corner.y), everywhere(corner.z)}, 0);
  }

  /// To another frame.
  TALUS_HD void move(const FrameChange& change) {
    for (int corner = 0; corner < 3; ++corner)
      for (int block = 0; block < block_count(); ++block)
        put(corner, block * kLanes, rounded(moved(change, widened(corners(corner, block)))));
  }

  TALUS_HD int block_count() const { return (count_ + kLanes - 1) / kLanes; }
  /// Eight of a triangle's corners 0, 1 and 2.
  TALUS_HD LaneVec3 corners(int corner, int block) const {
    const LocalReal* x = corner_[corner].data() + block * kLanes;
    return {load_lanes(x), load_lanes(x + kRow), load_lanes(x + 2 * kRow)};
  }
  /// 1 for a triangle of an outer face, 0 for one of a cut.
  TALUS_HD Lanes outer(int block) const { return load_lanes(outer_.data() + block * kLanes); }
  /// The first corner of the first triangle.
  TALUS_HD LocalVec3 point(int corner) const {
    return {corner_[corner][0], corner_[corner][kRow], corner_[corner][2 * kRow]};
  }

 private:
  static constexpr int kRow = kMost + 2 * kLanes;  // a whole register may be written at the end

  /// From lane 0 on: corner 0 for all, 1, 2, ... and 2, 3, ...
  TALUS_HD TALUS_INLINE void store(const LaneVec3& corners, LocalReal outer) {
    const LaneVec3 second = next_lane(corners);
    put(0, count_, first_lane(corners));
    put(1, count_, second);
    put(2, count_, next_lane(second));
    store_lanes(every_lane<Lanes>(outer), outer_.data() + count_);
  }
  TALUS_HD TALUS_INLINE void put(int corner, int at, const LaneVec3& points) {
    LocalReal* x = corner_[corner].data() + at;
    store_lanes(points.x, x);
    store_lanes(points.y, x + kRow);
    store_lanes(points.z, x + 2 * kRow);
  }

  ScratchArray<LocalReal, 3 * kRow> corner_[3];
  ScratchArray<LocalReal, kRow> outer_;
  int count_ = 0;
};

}  // namespace dem_gpu
