// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/real_lanes.h"
#include "dem_gpu/core/vec3.h"

// Consecutive rows of a column, as many as there are lanes, turned into one register a component and back.

namespace dem_gpu {

#if defined(__CUDACC__)

TALUS_HD inline Vec3 load_rows(const Vec3* first) { return *first; }
TALUS_HD inline void store_rows(const Vec3& values, Vec3* first) { *first = values; }
TALUS_HD inline Quaternion load_rows(const Quaternion* first) { return *first; }
TALUS_HD inline void store_rows(const Quaternion& values, Quaternion* first) { *first = values; }

#else

/// Which of 2 * kRealLanes numbers each lane takes.
struct PickedLanes {
  long long lane[kRealLanes];

  template <class Pick>
  explicit constexpr PickedLanes(const Pick& pick) : lane{} {
    for (int i = 0; i < kRealLanes; ++i) lane[i] = pick(i);
  }
  RealLanes of(const RealLanes& first, const RealLanes& second) const {
    LongLanes order;
    __builtin_memcpy(&order, lane, sizeof(order));
    return __builtin_shuffle(first, second, order);
  }
};

/// Registers of rows of `kWidth` numbers each, end to end: their number `k` of each row, and back.
template <int kWidth>
struct RowBlock {
  static_assert(kWidth == 3 || kWidth == 4);
  RealLanes block[kWidth];

  template <int k>
  RealLanes component() const {
    constexpr int n = kRealLanes;
    static constexpr PickedLanes of_first([](int i) { return (kWidth * i + k) % (2 * n); });
    static constexpr PickedLanes joined(
        [](int i) { return kWidth * i + k < 2 * n ? i : n + (kWidth == 3 ? (3 * i + k) % n : i); });
    const RealLanes low = of_first.of(block[0], block[1]);
    return joined.of(low, kWidth == 3 ? block[2] : of_first.of(block[2], block[kWidth - 1]));
  }
  template <int b>
  static RealLanes woven(const RealLanes (&components)[kWidth]) {
    constexpr int n = kRealLanes;
    static constexpr PickedLanes of_pair(
        [](int j) { return (b * n + j) / kWidth + ((b * n + j) % kWidth % 2 == 1 ? n : 0); });
    static constexpr PickedLanes joined([](int j) {
      const int row = (b * n + j) / kWidth, k = (b * n + j) % kWidth;
      return k < 2 ? j : n + (kWidth == 3 ? row : j);
    });
    const RealLanes low = of_pair.of(components[0], components[1]);
    return joined.of(low, kWidth == 3 ? components[2] : of_pair.of(components[2], components[kWidth - 1]));
  }

  static RowBlock load(const Real* numbers) {
    RowBlock rows;
    for (int b = 0; b < kWidth; ++b) rows.block[b] = load_lanes_at(numbers + b * kRealLanes);
    return rows;
  }
  static void store(const RealLanes& a, int b, Real* numbers) {
    __builtin_memcpy(numbers + b * kRealLanes, &a, sizeof(a));
  }
};

inline Vector3<RealLanes> load_rows(const Vec3* first) {
  const auto rows = RowBlock<3>::load(&first->x);
  return {rows.component<0>(), rows.component<1>(), rows.component<2>()};
}
inline void store_rows(const Vector3<RealLanes>& values, Vec3* first) {
  const RealLanes components[3] = {values.x, values.y, values.z};
  RowBlock<3>::store(RowBlock<3>::woven<0>(components), 0, &first->x);
  RowBlock<3>::store(RowBlock<3>::woven<1>(components), 1, &first->x);
  RowBlock<3>::store(RowBlock<3>::woven<2>(components), 2, &first->x);
}
inline BasicQuaternion<RealLanes> load_rows(const Quaternion* first) {
  const auto rows = RowBlock<4>::load(&first->w);
  return {rows.component<0>(), rows.component<1>(), rows.component<2>(), rows.component<3>()};
}
inline void store_rows(const BasicQuaternion<RealLanes>& values, Quaternion* first) {
  const RealLanes components[4] = {values.w, values.x, values.y, values.z};
  RowBlock<4>::store(RowBlock<4>::woven<0>(components), 0, &first->w);
  RowBlock<4>::store(RowBlock<4>::woven<1>(components), 1, &first->w);
  RowBlock<4>::store(RowBlock<4>::woven<2>(components), 2, &first->w);
  RowBlock<4>::store(RowBlock<4>::woven<3>(components), 3, &first->w);
}

#endif

}  // namespace dem_gpu
