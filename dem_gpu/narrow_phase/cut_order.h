// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/lanes.h"

namespace dem_gpu {

/// Of which corners those of a cut polygon are made: each lies between `from` and `to`, which are the same for a corner
/// that stays; lanes beyond the corners repeat the first.
struct alignas(32) CutOrder {
  LaneOrder from, to;
  std::uint8_t count;   // of corners; of more than kLanes the last is missing
  std::uint8_t inside;  // of them that stay
};

/// The corners inside that follow one another, from `first` on.
struct CornerRun {
  int first, count;
};

/// The longest row of corners inside. Those of a convex polygon are one row but for rounding.
TALUS_HD constexpr CornerRun run_inside(int corner_count, LaneSet inside) {
  if (inside == (1u << corner_count) - 1) return {0, corner_count};
  CornerRun longest{0, 0};
  for (int first = 0; first < corner_count; ++first) {
    int count = 0;
    while (inside >> ((first + count) % corner_count) & 1) ++count;
    if (count > longest.count) longest = {first, count};
  }
  return longest;
}

/// Of a polygon of `corner_count` corners of which these are inside: the run of corners inside, then the points where
/// the boundary leaves and enters; all or nothing where it does neither.
TALUS_HD constexpr CutOrder make_cut_order(int corner_count, LaneSet inside) {
  const CornerRun run = run_inside(corner_count, inside);
  const bool is_cut = run.count > 0 && run.count < corner_count;
  CutOrder order{};
  order.inside = static_cast<std::uint8_t>(run.count);
  order.count = static_cast<std::uint8_t>(is_cut ? run.count + 2 : run.count);
  for (int i = 0; i < kLanes; ++i) {
    int from = run.first, to = run.first;
    if (i < run.count) {
      from = to = (run.first + i) % corner_count;
    } else if (is_cut && i == run.count) {  // the boundary leaves
      from = (run.first + run.count - 1) % corner_count;
      to = (run.first + run.count) % corner_count;
    } else if (is_cut && i == run.count + 1) {  // and enters
      to = (run.first + corner_count - 1) % corner_count;
    }
    order.from.lane[i] = static_cast<std::uint8_t>(from);
    order.to.lane[i] = static_cast<std::uint8_t>(to);
  }
  return order;
}

#if defined(__CUDACC__)

TALUS_HD inline CutOrder cut_order(int corner_count, LaneSet inside) { return make_cut_order(corner_count, inside); }

#else

/// All of them, for 3 to kLanes corners.
struct CutOrders {
  CutOrder order[kLanes + 1][1 << kLanes];

  constexpr CutOrders() : order{} {
    for (int count = 3; count <= kLanes; ++count)
      for (LaneSet inside = 0; inside < 1u << count; ++inside) order[count][inside] = make_cut_order(count, inside);
  }
};
inline constexpr CutOrders kCutOrders;

inline const CutOrder& cut_order(int corner_count, LaneSet inside) { return kCutOrders.order[corner_count][inside]; }

#endif

}  // namespace dem_gpu
