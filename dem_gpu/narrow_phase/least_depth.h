// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// A polygon cut down step by step.
struct ShrinkingPolygon {
  Polygon piece;
  bool is_empty = false;

  /// Keeps what lies in the cell. A piece wholly on the cell's boundary stays only if `owns_ties`. False, and all is
  /// kept, if what lies there has more corners than a polygon holds: HalvesToCut.
  TALUS_HD bool keep(const LocalHalfSpace& cell, bool owns_ties) {
    const Lanes margins = depths_below(cell, piece.corners);
    const auto& order = cut_order(piece, margins);
    if (outgrows(order)) return false;
    const bool is_flush = lanes_above(margins, Lanes{}) == 0;
    is_empty = is_flush && !(owns_ties && corners_inside(piece, margins) == piece.all());
    piece = cut(piece, margins, order);
    return true;
  }
};

/// Halves of a polygon that outgrew its lanes, put aside until the rest of it is done, each with the cuts left to it.
class HalvesToCut {
 public:
  /// Goes on with one half of the polygon; the other one waits. If there is no room for it the polygon is truncated.
  TALUS_HD void split(ShrinkingPolygon& polygon, std::uint64_t cuts_left) {
    if (count_ == kMost) {
      polygon.piece.is_truncated = true;
      return;
    }
    cuts_left_[count_] = cuts_left;
    half_[count_++] = half_of(polygon.piece, true);
    polygon.piece = half_of(polygon.piece, false);
  }
  /// False if no half waits.
  TALUS_HD bool next(ShrinkingPolygon& polygon, std::uint64_t& cuts_left) {
    if (count_ == 0) return false;
    polygon = {half_[--count_]};
    cuts_left = cuts_left_[count_];
    return true;
  }

 private:
  static constexpr int kMost = 8;
  ScratchArray<Polygon, kMost> half_;
  ScratchArray<std::uint64_t, kMost> cuts_left_;
  int count_ = 0;
};

/// Planes that a depth field may have near one polygon, those of terms that are one plane there among them; and terms
/// that are not, with their planes.
inline constexpr int kMostTermsOnPolygon = 48, kMostTermPlanesOnPolygon = 160;
inline constexpr int kMostPlanesOnPolygon = NearField::kMostPlanes + kMostTermsOnPolygon;

/// Where the depth below `low` is at most that below `high`.
TALUS_HD inline LocalHalfSpace lower_side(const LocalHalfSpace& low, const LocalHalfSpace& high) {
  return {high.normal - low.normal, high.offset - low.offset};
}

/// Least and largest depth of a polygon below a plane; its corners have them.
TALUS_HD inline DepthRange depth_range(const Polygon& polygon, const LocalHalfSpace& plane) {
  const Lanes depths = depths_below(plane, polygon.corners);
  return {least_lane(depths), greatest_lane(depths)};
}

/// Planes that may each be the least somewhere on a polygon, compared by their depths at its corners.
class Contenders {
 public:
  static constexpr int kMost = 64;

  TALUS_HD void add(const Lanes& depths) {
    depths_[count_] = depths;
    cutting_[count_] = 0;
    standing_ |= std::uint64_t{1} << count_++;
  }
  TALUS_HD int count() const { return count_; }
  TALUS_HD const Lanes& depths(int k) const { return depths_[k]; }
  TALUS_HD void drop(int k) { standing_ &= ~(std::uint64_t{1} << k); }

  /// To be called when all are in.
  TALUS_HD void compare() {
    for (std::uint64_t left = standing_; left != 0; left &= left - 1) {
      const int k = lowest_bit(left);
      for (std::uint64_t others = left & (left - 1) & standing_; others != 0 && stands(k); others &= others - 1)
        compare(k, lowest_bit(others));
    }
  }

  TALUS_HD std::uint64_t standing() const { return standing_; }
  /// The planes that are below plane k on a part of the polygon, a bit each.
  TALUS_HD std::uint64_t cutting(int k) const { return cutting_[k] & standing_; }

 private:
  /// False if another plane is nowhere above plane k.
  TALUS_HD bool stands(int k) const { return (standing_ >> k & 1) != 0; }
  TALUS_HD void compare(int k, int m) {
    if (!stands(m)) return;
    const bool k_is_lower = lanes_above(depths_[m], depths_[k]) != 0;
    const bool m_is_lower = lanes_above(depths_[k], depths_[m]) != 0;
    if (k_is_lower && m_is_lower) {
      cutting_[k] |= std::uint64_t{1} << m;
      cutting_[m] |= std::uint64_t{1} << k;
    } else {
      drop(m_is_lower ? k : m);  // of equal ones the lower index stands
    }
  }

  ScratchArray<Lanes, kMost> depths_;  // at the corners
  ScratchArray<std::uint64_t, kMost> cutting_;
  std::uint64_t standing_ = 0;
  int count_ = 0;
};

/// visitor(piece, plane) for the pieces on which each contender is least, of those still standing. `contending`: the
/// plane of each.
template <class Visitor>
TALUS_HD TALUS_DEVICE_CALL void visit_cells(const Polygon& polygon, const LocalHalfSpace* planes,
                                            const std::uint8_t* contending, Contenders& contenders, Visitor&& visitor) {
  contenders.compare();
  for (std::uint64_t standing = contenders.standing(); standing != 0; standing &= standing - 1) {
    const int k = lowest_bit(standing);
    ShrinkingPolygon cell{polygon};
    HalvesToCut halves;
    std::uint64_t left = contenders.cutting(k);
    do {
      while (left != 0 && !cell.is_empty && !cell.piece.is_truncated) {
        const int m = lowest_bit(left);
        if (cell.keep(lower_side(planes[contending[k]], planes[contending[m]]), k < m))
          left &= left - 1;
        else
          halves.split(cell, left);
      }
      if (!cell.is_empty) visitor(cell.piece, planes[contending[k]]);
    } while (halves.next(cell, left));
  }
}
static_assert(kMostPlanesOnPolygon <= 256);

/// The same as visit_least_depth for any number of planes, each compared with each.
template <class Visitor>
TALUS_HD TALUS_DEVICE_CALL void visit_every_cell(const Polygon& polygon, const LocalHalfSpace* planes, int plane_count,
                                                 Visitor&& visitor) {
  for (int k = 0; k < plane_count; ++k) {
    ShrinkingPolygon cell{polygon};
    HalvesToCut halves;
    std::uint64_t m = 0;
    do {
      while (m < static_cast<std::uint64_t>(plane_count) && !cell.is_empty && !cell.piece.is_truncated) {
        const int other = static_cast<int>(m);
        if (other == k || cell.keep(lower_side(planes[k], planes[other]), k < other))
          ++m;
        else
          halves.split(cell, m);
      }
      if (!cell.is_empty) visitor(cell.piece, planes[k]);
    } while (halves.next(cell, m));
  }
}

/// Cuts a polygon into the pieces on which each of `planes` is the one it lies least deep below: visitor(piece, plane).
/// One piece where one plane is least at all corners. The lower index owns a tie.
template <class Visitor>
TALUS_HD TALUS_DEVICE_CALL void visit_least_depth(const Polygon& polygon, const LocalHalfSpace* planes, int plane_count,
                                                  Visitor&& visitor) {
  if (plane_count == 1) {
    visitor(polygon, planes[0]);
    return;
  }
  // A plane is no contender if another one is below it at every corner: it suffices to compare with the one that is
  // least at the first.
  int flattest = 0;
  LocalReal least_first = std::numeric_limits<LocalReal>::max();
  const LocalVec3 corner = polygon.corner(0);
  for (int i = 0; i < plane_count; ++i) {
    const LocalReal depth = depth_below(planes[i], corner);
    if (depth < least_first) least_first = depth, flattest = i;
  }
  const Lanes bound = depths_below(planes[flattest], polygon.corners);
  Contenders contenders;
  ScratchArray<std::uint8_t, Contenders::kMost> contending;
  for (int i = 0; i < plane_count; ++i) {
    const Lanes depths = depths_below(planes[i], polygon.corners);
    if (i != flattest && lanes_above(bound, depths) == 0) continue;
    if (contenders.count() == Contenders::kMost) {
      visit_every_cell(polygon, planes, plane_count, visitor);
      return;
    }
    contending[contenders.count()] = static_cast<std::uint8_t>(i);
    contenders.add(depths);
  }
  if (contenders.count() == 1) {
    visitor(polygon, planes[flattest]);
    return;
  }
  visit_cells(polygon, planes, contending.data(), contenders, visitor);
}

}  // namespace dem_gpu
