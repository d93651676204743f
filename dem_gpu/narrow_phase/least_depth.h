// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/polygon.h"

namespace dem_gpu {

/// A polygon cut down step by step, between two buffers.
struct ShrinkingPolygon {
  const Polygon* piece;  // null once nothing is left
  Polygon* buffer;       // two
  int next = 0;

  /// Keeps what lies in the cell. A piece wholly on the cell's boundary stays only if `owns_ties`.
  TALUS_HD void keep(const LocalHalfSpace& cell, bool owns_ties) {
    CornerDepths margins;
    bool all_inside = true, all_outside = true;
    for (int c = 0; c < piece->count; ++c) {
      const LocalReal margin = depth_below(cell, piece->corner[c]);
      if (margin < 0) all_inside = false;
      if (margin > 0 || (margin == 0 && owns_ties)) all_outside = false;
      margins[c] = margin;
    }
    if (all_outside) {
      piece = nullptr;
    } else if (!all_inside) {
      clip(*piece, margins, buffer[next]);
      piece = buffer[next].count > 0 ? &buffer[next] : nullptr;
      next = 1 - next;
    }
  }
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
  DepthRange range;
  range.shallowest = range.deepest = depth_below(plane, polygon.corner[0]);
  for (int c = 1; c < polygon.count; ++c) {
    const LocalReal depth = depth_below(plane, polygon.corner[c]);
    range.shallowest = depth < range.shallowest ? depth : range.shallowest;
    range.deepest = depth > range.deepest ? depth : range.deepest;
  }
  return range;
}

/// Planes that may each be the least somewhere on a polygon, compared by their depths at its corners.
class Contenders {
 public:
  static constexpr int kMost = 64, kMostDepths = 512;

  /// With more planes or corners than fit, no comparison is made.
  TALUS_HD static bool fits(int count, int corners) { return count <= kMost && count * corners <= kMostDepths; }

  TALUS_HD void add(const Polygon& polygon, const LocalHalfSpace& plane) {
    LocalReal* depth = depth_.data() + count_ * polygon.count;
    for (int c = 0; c < polygon.count; ++c) depth[c] = depth_below(plane, polygon.corner[c]);
    cutting_[count_] = 0;
    standing_ |= std::uint64_t{1} << count_++;
  }

  /// To be called when all are in.
  TALUS_HD void compare(int corners) {
    for (int k = 0; k < count_; ++k)
      for (int m = k + 1; m < count_ && stands(k); ++m)
        if (stands(m)) compare(k, m, corners);
  }

  /// False if another plane is nowhere above plane k.
  TALUS_HD bool stands(int k) const { return (standing_ >> k & 1) != 0; }
  /// The planes that are below plane k on a part of the polygon, a bit each.
  TALUS_HD std::uint64_t cutting(int k) const { return cutting_[k] & standing_; }

 private:
  TALUS_HD void compare(int k, int m, int corners) {
    const LocalReal *of_k = depth_.data() + k * corners, *of_m = depth_.data() + m * corners;
    bool k_is_lower = false, m_is_lower = false;
    for (int c = 0; c < corners; ++c) {
      k_is_lower |= of_k[c] < of_m[c];
      m_is_lower |= of_m[c] < of_k[c];
    }
    if (k_is_lower && m_is_lower) {
      cutting_[k] |= std::uint64_t{1} << m;
      cutting_[m] |= std::uint64_t{1} << k;
    } else {
      standing_ &= ~(std::uint64_t{1} << (m_is_lower ? k : m));  // of equal ones the lower index stands
    }
  }

  ScratchArray<LocalReal, kMostDepths> depth_;  // at the corners, plane by plane
  ScratchArray<std::uint64_t, kMost> cutting_;
  std::uint64_t standing_ = 0;
  int count_ = 0;
};

TALUS_HD inline int lowest_bit(std::uint64_t bits) { return count_bits((bits & (~bits + 1)) - 1); }

/// Cuts a polygon into the pieces on which each of `planes` is the one it lies least deep below: visitor(piece, plane).
/// One piece where one plane is least at all corners. The lower index owns a tie.
template <class Visitor>
TALUS_HD void visit_least_depth(const Polygon& polygon, const LocalHalfSpace* planes, int plane_count,
                                Visitor&& visitor) {
  // A plane is no candidate if another one is below it at every corner: it suffices to compare with the plane whose
  // largest depth is least.
  constexpr int kLargest = kMostPlanesOnPolygon;
  ScratchArray<LocalReal, kLargest> shallowest;
  ScratchArray<std::int16_t, kLargest> candidate;
  LocalReal least_deepest = std::numeric_limits<LocalReal>::max();
  int flattest = 0;
  for (int i = 0; i < plane_count; ++i) {
    const DepthRange range = depth_range(polygon, planes[i]);
    shallowest[i] = range.shallowest;
    if (range.deepest < least_deepest) least_deepest = range.deepest, flattest = i;
  }
  int count = 0;
  for (int i = 0; i < plane_count; ++i)
    if (i == flattest || shallowest[i] < least_deepest) candidate[count++] = static_cast<std::int16_t>(i);
  if (count == 1) {
    visitor(polygon, planes[candidate[0]]);
    return;
  }
  Polygon buffer[2];
  if (!Contenders::fits(count, polygon.count)) {
    for (int k = 0; k < count; ++k) {
      const LocalHalfSpace own = planes[candidate[k]];
      ShrinkingPolygon cell{&polygon, buffer};
      for (int m = 0; m < count && cell.piece; ++m)
        if (m != k) cell.keep(lower_side(own, planes[candidate[m]]), k < m);
      if (cell.piece) visitor(*cell.piece, own);
    }
    return;
  }
  Contenders contenders;
  for (int k = 0; k < count; ++k) contenders.add(polygon, planes[candidate[k]]);
  contenders.compare(polygon.count);
  for (int k = 0; k < count; ++k) {
    if (!contenders.stands(k)) continue;
    const LocalHalfSpace own = planes[candidate[k]];
    ShrinkingPolygon cell{&polygon, buffer};
    for (std::uint64_t left = contenders.cutting(k); left != 0 && cell.piece; left &= left - 1) {
      const int m = lowest_bit(left);
      cell.keep(lower_side(own, planes[candidate[m]]), k < m);
    }
    if (cell.piece) visitor(*cell.piece, own);
  }
}

}  // namespace dem_gpu
