// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/part_vertices.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// The pieces of one part's surface that lie inside another, kept so that what is near all of them can be found before
/// each is integrated.
class SurfacePieces {
 public:
  static constexpr int kMostCorners = 192, kMost = 64;

  /// Corners of all pieces.
  PointColumns<kMostCorners> corners;

  TALUS_HD SurfacePieces() { corners.count = 0; }

  TALUS_HD void add(const Polygon& polygon, int face) {
    if (count_ == kMost || corners.count + polygon.count > kMostCorners) has_room_ = false;
    if (!has_room_) return;
    face_[count_] = static_cast<std::uint8_t>(face);
    first_[count_++] = static_cast<std::int16_t>(corners.count);
    for (int c = 0; c < polygon.count; ++c) corners.set(corners.count++, polygon.corner[c]);
  }

  /// False if not all pieces are here.
  TALUS_HD bool is_complete() const { return has_room_; }
  TALUS_HD int count() const { return count_; }

  /// visitor(polygon, face) for each piece.
  template <class Visitor>
  TALUS_HD void visit(Visitor&& visitor) const {
    Polygon polygon;
    for (int k = 0; k < count_; ++k) {
      const int last = k + 1 < count_ ? first_[k + 1] : corners.count;
      polygon.count = last - first_[k];
      for (int c = 0; c < polygon.count; ++c) polygon.corner[c] = corners[first_[k] + c];
      visitor(polygon, int(face_[k]));
    }
  }

 private:
  ScratchArray<std::int16_t, kMost> first_;
  ScratchArray<std::uint8_t, kMost> face_;
  int count_ = 0;
  bool has_room_ = true;
};
static_assert(kMaxPartFaces <= 256);

}  // namespace dem_gpu
