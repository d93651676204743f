// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// The pieces of one part's surface that lie inside another, kept so that what is near all of them can be found before
/// each is integrated.
class SurfacePieces {
 public:
  static constexpr int kMost = 24;

  TALUS_HD void add(const Polygon& polygon, int face) {
    if (count_ == kMost) has_room_ = false;
    if (!has_room_) return;
    face_[count_] = static_cast<std::uint8_t>(face);
    piece_[count_++] = polygon;
  }

  /// False if not all pieces are here.
  TALUS_HD bool is_complete() const { return has_room_; }
  TALUS_HD int count() const { return count_; }

  // Corners of all pieces, a block a piece.
  TALUS_HD int block_count() const { return count_; }
  TALUS_HD const LaneVec3& block(int i) const { return piece_[i].corners; }

  /// visitor(polygon, face) for each piece.
  template <class Visitor>
  TALUS_HD void visit(Visitor&& visitor) {
    for (int k = 0; k < count_; ++k) visitor(piece_[k], int(face_[k]));
  }

 private:
  ScratchArray<Polygon, kMost> piece_;
  ScratchArray<std::uint8_t, kMost> face_;
  int count_ = 0;
  bool has_room_ = true;
};
static_assert(kMaxPartFaces <= 256);

}  // namespace dem_gpu
