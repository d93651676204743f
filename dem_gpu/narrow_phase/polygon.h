// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "dem_gpu/narrow_phase/cut_order.h"
#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// Planar convex polygon of up to kLanes corners, a lane each; lanes beyond the last corner repeat the first, so that
/// sums over the triangles of its fan and extremes over its corners need no mask. A face of more corners is several of
/// these.
struct Polygon {
  LaneVec3 corners;
  int count = 0;
  bool is_truncated = false;  // a corner did not fit: reported by the host, never dropped in silence

  TALUS_HD LocalVec3 corner(int i) const { return point_at(corners, i); }
  /// Its lanes that are corners.
  TALUS_HD LaneSet all() const { return (1u << count) - 1; }
};

/// Corners that are not above a plane, from their depths below it.
TALUS_HD TALUS_INLINE LaneSet corners_inside(const Polygon& polygon, const Lanes& depths) {
  return ~lanes_above(Lanes{}, depths) & polygon.all();
}

/// Of the rows of corners inside, the one with the deepest corner. There are several by rounding alone, where corners
/// lie within rounding of one another: the others are next to nothing.
TALUS_HD TALUS_ONE_COPY inline LaneSet deepest_row(const Polygon& polygon, const Lanes& depths, LaneSet inside) {
  int deepest = 0;
  for (int i = 1; i < polygon.count; ++i) deepest = depths[i] > depths[deepest] ? i : deepest;
  LaneSet row = 0;
  for (int i = deepest; (inside >> i & 1) != 0 && (row >> i & 1) == 0; i = (i + 1) % polygon.count) row |= 1u << i;
  const auto before = [&](int i) { return (i + polygon.count - 1) % polygon.count; };
  for (int i = before(deepest); (inside >> i & 1) != 0 && (row >> i & 1) == 0; i = before(i)) row |= 1u << i;
  return row;
}

/// How a plane cuts a polygon, from the depths of its corners below it.
TALUS_HD TALUS_INLINE auto cut_order(const Polygon& polygon, const Lanes& depths) -> decltype(cut_order(0, 0u)) {
  const LaneSet inside = corners_inside(polygon, depths);
  const CutOrder& order = cut_order(polygon.count, inside);
  if (order.inside == count_bits(inside)) return order;
  return cut_order(polygon.count, deepest_row(polygon, depths, inside));
}
TALUS_HD TALUS_INLINE bool outgrows(const CutOrder& order) { return order.count > kLanes; }

/// What a plane leaves of a polygon. The same steps whether it cuts, leaves all or nothing: which of these it is is
/// what a processor guesses badly.
TALUS_HD TALUS_INLINE Polygon cut(const Polygon& polygon, const Lanes& depths, const CutOrder& order) {
  const LaneIndex from = lane_index(order.from), to = lane_index(order.to);
  // Where `from` and `to` are one corner, the quotient is 1 or 0 and the corner stays as it is.
  const Lanes depth_from = in_order(depths, from), depth_to = least(in_order(depths, to), Lanes{});
  const Lanes some = every_lane<Lanes>(std::numeric_limits<LocalReal>::min());
  const Lanes share = depth_from / greatest(depth_from - depth_to, some);
  const LaneVec3 start = in_order(polygon.corners, from), end = in_order(polygon.corners, to);
  return {start + share * (end - start), outgrows(order) ? kLanes : order.count,
          polygon.is_truncated || outgrows(order)};
}

/// One side of the diagonal from the first corner that halves the polygon.
TALUS_HD inline Polygon half_of(const Polygon& polygon, bool is_second) {
  const int middle = polygon.count / 2, count = is_second ? polygon.count - middle + 1 : middle + 1;
  LaneOrder order;
  for (int i = 0; i < kLanes; ++i) {
    const int corner = i == 0 || i >= count ? 0 : is_second ? middle + i - 1 : i;
    order.lane[i] = static_cast<std::uint8_t>(corner);
  }
  return {in_order(polygon.corners, lane_index(order)), count, polygon.is_truncated};
}

}  // namespace dem_gpu
