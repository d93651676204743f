// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/intrinsics.h"
#include "dem_gpu/core/real.h"
#if defined(__AVX2__) && !defined(__AVX512F__) && !defined(__CUDACC__)
#define TALUS_LANE_HALVES 1
#include "dem_gpu/core/lane_halves.h"
#endif

// Eight numbers of contact geometry worked on together: the corners of a polygon, or eight vertices of a part. One
// vector register on the CPU (the compiler splits it where registers are shorter), an array on the GPU. Written with
// vector types rather than loops, which GCC 12 does not turn into vector code; the few operations that those types do
// not have are given for the instruction sets that have them.

namespace dem_gpu {

inline constexpr int kLanes = 8;

/// A choice of lanes: bit i for lane i.
using LaneSet = unsigned;

/// A lane for each lane: in_order(a, order)[i] == a[order[i]].
struct LaneOrder {
  std::uint8_t lane[kLanes];
};

TALUS_HD inline int count_bits(std::uint64_t bits) {
#if defined(__CUDA_ARCH__)
  return __popcll(bits);
#else
  return __builtin_popcountll(bits);
#endif
}

/// Index of the lowest bit that is set.
TALUS_HD inline int lowest_bit(std::uint64_t bits) { return count_bits((bits & (~bits + 1)) - 1); }

#if defined(__CUDACC__)

template <class Number>
struct LaneArray {
  Number value[kLanes];

  TALUS_HD Number& operator[](int i) { return value[i]; }
  TALUS_HD Number operator[](int i) const { return value[i]; }

  template <class Operation>
  TALUS_HD static LaneArray each(const Operation& operation) {
    LaneArray result;
#pragma unroll
    for (int i = 0; i < kLanes; ++i) result.value[i] = operation(i);
    return result;
  }
  TALUS_HD friend LaneArray operator+(const LaneArray& a, const LaneArray& b) {
    return each([&](int i) { return a[i] + b[i]; });
  }
  TALUS_HD friend LaneArray operator-(const LaneArray& a, const LaneArray& b) {
    return each([&](int i) { return a[i] - b[i]; });
  }
  TALUS_HD friend LaneArray operator*(const LaneArray& a, const LaneArray& b) {
    return each([&](int i) { return a[i] * b[i]; });
  }
  TALUS_HD friend LaneArray operator/(const LaneArray& a, const LaneArray& b) {
    return each([&](int i) { return a[i] / b[i]; });
  }
  TALUS_HD friend LaneArray operator+(const LaneArray& a, Number b) {
    return each([&](int i) { return a[i] + b; });
  }
  TALUS_HD friend LaneArray operator-(const LaneArray& a, Number b) {
    return each([&](int i) { return a[i] - b; });
  }
  TALUS_HD friend LaneArray operator-(Number a, const LaneArray& b) {
    return each([&](int i) { return a - b[i]; });
  }
  TALUS_HD friend LaneArray operator*(Number a, const LaneArray& b) {
    return each([&](int i) { return a * b[i]; });
  }
  TALUS_HD LaneArray& operator+=(const LaneArray& b) { return *this = *this + b; }
};

using Lanes = LaneArray<LocalReal>;
using WideLanes = LaneArray<Real>;

template <class Number>
TALUS_HD LaneArray<Number> load_lanes(const Number* values) {
  return LaneArray<Number>::each([&](int i) { return values[i]; });
}
template <class Number>
TALUS_HD void store_lanes(const LaneArray<Number>& a, Number* values) {
  for (int i = 0; i < kLanes; ++i) values[i] = a[i];
}
TALUS_HD inline WideLanes widened(const Lanes& a) {
  return WideLanes::each([&](int i) { return Real(a[i]); });
}
TALUS_HD inline Lanes rounded(const WideLanes& a) {
  return Lanes::each([&](int i) { return LocalReal(a[i]); });
}
template <class Number>
TALUS_HD LaneArray<Number> least(const LaneArray<Number>& a, const LaneArray<Number>& b) {
  return LaneArray<Number>::each([&](int i) { return a[i] < b[i] ? a[i] : b[i]; });
}
template <class Number>
TALUS_HD LaneArray<Number> greatest(const LaneArray<Number>& a, const LaneArray<Number>& b) {
  return LaneArray<Number>::each([&](int i) { return a[i] > b[i] ? a[i] : b[i]; });
}
template <class Number>
TALUS_HD LaneArray<Number> in_order(const LaneArray<Number>& a, const LaneOrder& order) {
  return LaneArray<Number>::each([&](int i) { return a[order.lane[i]]; });
}
using LaneIndex = LaneOrder;
TALUS_HD inline LaneIndex lane_index(const LaneOrder& order) { return order; }
template <class Number>
TALUS_HD LaneArray<Number> swapped_lanes(const LaneArray<Number>& a, int distance) {
  return LaneArray<Number>::each([&](int i) { return a[i ^ distance]; });
}
/// Lane i becomes lane i + 1, the last one the first.
TALUS_HD inline Lanes next_lane(const Lanes& a) {
  return Lanes::each([&](int i) { return a[(i + 1) % kLanes]; });
}
/// Bit i where a[i] > b[i].
template <class Number>
TALUS_HD LaneSet lanes_above(const LaneArray<Number>& a, const LaneArray<Number>& b) {
  LaneSet set = 0;
#pragma unroll
  for (int i = 0; i < kLanes; ++i) set |= static_cast<LaneSet>(a[i] > b[i]) << i;
  return set;
}
template <class SomeLanes, class Number>
TALUS_HD SomeLanes every_lane(Number value) {
  return SomeLanes::each([&](int) { return value; });
}
TALUS_HD inline Lanes gathered(const LocalReal* values, const LaneOrder& order) {
  return Lanes::each([&](int i) { return values[order.lane[i]]; });
}

#else

#if defined(TALUS_LANE_HALVES)
using WideLanes = LaneHalves;
#else
using WideLanes = Real __attribute__((vector_size(kLanes * sizeof(Real))));
#endif
using WideIndex = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

#if defined(TALUS_MIXED_PRECISION)
using Lanes = LocalReal __attribute__((vector_size(kLanes * sizeof(LocalReal))));
using LaneIndex = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
#if defined(TALUS_LANE_HALVES)
inline WideLanes widened(const Lanes& a) {
  const __m256 lanes = __m256(a);
  return {LaneHalves::Half(_mm256_cvtps_pd(_mm256_castps256_ps128(lanes))),
          LaneHalves::Half(_mm256_cvtps_pd(_mm256_extractf128_ps(lanes, 1)))};
}
inline Lanes rounded(const WideLanes& a) {
  return Lanes(_mm256_set_m128(_mm256_cvtpd_ps(__m256d(a.high)), _mm256_cvtpd_ps(__m256d(a.low))));
}
#else
inline WideLanes widened(const Lanes& a) { return __builtin_convertvector(a, WideLanes); }
inline Lanes rounded(const WideLanes& a) { return __builtin_convertvector(a, Lanes); }
#endif
#else
using Lanes = WideLanes;
#if defined(TALUS_LANE_HALVES)
using LaneIndex = HalvesIndex;
#else
using LaneIndex = WideIndex;
#endif
inline WideLanes widened(const Lanes& a) { return a; }
inline Lanes rounded(const WideLanes& a) { return a; }
#endif

template <class SomeLanes, class Number>
SomeLanes every_lane(Number value) {
  return value - SomeLanes{};
}

// Of a vector type.
template <class SomeLanes>
SomeLanes least(const SomeLanes& a, const SomeLanes& b) {
  return a < b ? a : b;
}
template <class SomeLanes>
SomeLanes greatest(const SomeLanes& a, const SomeLanes& b) {
  return a > b ? a : b;
}
template <class SomeLanes>
SomeLanes swapped_lanes(const SomeLanes& a, int distance) {
  using Index = std::conditional_t<sizeof(SomeLanes) == sizeof(WideIndex), WideIndex, LaneIndex>;
  const Index identity{0, 1, 2, 3, 4, 5, 6, 7};
  return __builtin_shuffle(a, identity ^ static_cast<std::int32_t>(distance));
}

#if defined(TALUS_LANE_HALVES) && !defined(TALUS_MIXED_PRECISION)

inline Lanes load_lanes(const LocalReal* values) { return load_halves(values); }
/// An order unpacked, for use on several numbers.
inline LaneIndex lane_index(const LaneOrder& order) { return LaneIndex(order.lane); }
inline Lanes gathered(const LocalReal* values, const LaneOrder& order) {
  const auto at = [&](int i) { return values[order.lane[i]]; };
  return {LaneHalves::Half{at(0), at(1), at(2), at(3)}, LaneHalves::Half{at(4), at(5), at(6), at(7)}};
}

#else

inline Lanes load_lanes(const LocalReal* values) {
  Lanes lanes;
  __builtin_memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}
inline void store_lanes(const Lanes& a, LocalReal* values) { __builtin_memcpy(values, &a, sizeof(a)); }

/// An order unpacked, for use on several numbers.
inline LaneIndex lane_index(const LaneOrder& order) {
#if defined(__AVX512F__) && !defined(TALUS_MIXED_PRECISION)
  return LaneIndex(_mm512_maskz_cvtepu8_epi64(0xff, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(order.lane))));
#elif defined(__AVX2__) && defined(TALUS_MIXED_PRECISION)
  return LaneIndex(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(order.lane))));
#else
  LaneIndex index;
  for (int i = 0; i < kLanes; ++i) index[i] = order.lane[i];
  return index;
#endif
}
inline Lanes in_order(const Lanes& a, const LaneIndex& index) { return __builtin_shuffle(a, index); }
inline Lanes next_lane(const Lanes& a) { return __builtin_shuffle(a, LaneIndex{1, 2, 3, 4, 5, 6, 7, 0}); }

inline Lanes gathered(const LocalReal* values, const LaneOrder& order) {
#if defined(__AVX512F__) && !defined(TALUS_MIXED_PRECISION)
  return Lanes(
      _mm512_mask_i64gather_pd(_mm512_setzero_pd(), 0xff, __m512i(lane_index(order)), values, sizeof(LocalReal)));
#else
  Lanes lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = values[order.lane[i]];
  return lanes;
#endif
}

#endif

#if !defined(TALUS_LANE_HALVES)
inline LaneSet lanes_above(const WideLanes& a, const WideLanes& b) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), _CMP_GT_OQ);
#else
  LaneSet set = 0;
  for (int i = 0; i < kLanes; ++i) set |= static_cast<LaneSet>(a[i] > b[i]) << i;
  return set;
#endif
}
#endif
#if defined(TALUS_MIXED_PRECISION)
inline LaneSet lanes_above(const Lanes& a, const Lanes& b) {
#if defined(__AVX__)
  return static_cast<LaneSet>(_mm256_movemask_ps(_mm256_cmp_ps(__m256(a), __m256(b), _CMP_GT_OQ)));
#else
  LaneSet set = 0;
  for (int i = 0; i < kLanes; ++i) set |= static_cast<LaneSet>(a[i] > b[i]) << i;
  return set;
#endif
}
#endif

#endif

/// From sixteen numbers.
TALUS_HD inline Lanes in_order(const Lanes& low, const Lanes& high, const LaneOrder& order) {
#if defined(__CUDACC__)
  return Lanes::each([&](int i) { return order.lane[i] < kLanes ? low[order.lane[i]] : high[order.lane[i] - kLanes]; });
#elif defined(TALUS_LANE_HALVES) && !defined(TALUS_MIXED_PRECISION)
  LocalReal values[2 * kLanes];
  store_lanes(low, values);
  store_lanes(high, values + kLanes);
  return gathered(values, order);
#else
  return __builtin_shuffle(low, high, lane_index(order));
#endif
}

/// Which of eight sets of vertices hold all of `some`.
TALUS_HD inline LaneSet sets_holding_all(const std::uint64_t* sets, std::uint64_t some) {
#if defined(__AVX512F__) && !defined(__CUDACC__)
  const __m512i wanted = _mm512_set1_epi64(static_cast<long long>(some));
  return _mm512_cmpeq_epi64_mask(_mm512_and_si512(_mm512_loadu_si512(sets), wanted), wanted);
#elif defined(TALUS_LANE_HALVES)
  const __m256i wanted = _mm256_set1_epi64x(static_cast<long long>(some));
  const auto holding_four = [&](const std::uint64_t* four) {
    const __m256i set = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(four));
    const __m256i holding = _mm256_cmpeq_epi64(_mm256_and_si256(set, wanted), wanted);
    return static_cast<LaneSet>(_mm256_movemask_pd(_mm256_castsi256_pd(holding)));
  };
  return holding_four(sets) | holding_four(sets + 4) << 4;
#else
  LaneSet holding = 0;
  for (int i = 0; i < kLanes; ++i) holding |= static_cast<LaneSet>((sets[i] & some) == some) << i;
  return holding;
#endif
}

/// The sum of all lanes, and the least and the greatest one, by halves: the same order on every machine.
template <class SomeLanes>
TALUS_HD auto sum_of_lanes(const SomeLanes& a) {
  const SomeLanes fours = a + swapped_lanes(a, 4), twos = fours + swapped_lanes(fours, 2);
  return twos[0] + twos[1];
}
template <class SomeLanes>
TALUS_HD auto least_lane(const SomeLanes& a) {
  const SomeLanes fours = least(a, swapped_lanes(a, 4)), twos = least(fours, swapped_lanes(fours, 2));
  return twos[0] < twos[1] ? twos[0] : twos[1];
}
template <class SomeLanes>
TALUS_HD auto greatest_lane(const SomeLanes& a) {
  const SomeLanes fours = greatest(a, swapped_lanes(a, 4)), twos = greatest(fours, swapped_lanes(fours, 2));
  return twos[0] > twos[1] ? twos[0] : twos[1];
}
/// Lane k: the sum of the lanes of `of[k]`; on the CPU neighbours first.
template <class SomeLanes>
TALUS_HD TALUS_INLINE SomeLanes sums_of_lanes(const SomeLanes (&of)[kLanes]) {
#if defined(__CUDACC__)
  return SomeLanes::each([&](int i) { return sum_of_lanes(of[i]); });
#else
  using Index = std::conditional_t<sizeof(SomeLanes) == sizeof(WideIndex), WideIndex, LaneIndex>;
  const auto pairs = [](const SomeLanes& a, const SomeLanes& b) {
    return __builtin_shuffle(a, b, Index{0, 8, 2, 10, 4, 12, 6, 14}) +
           __builtin_shuffle(a, b, Index{1, 9, 3, 11, 5, 13, 7, 15});
  };
  const auto halves = [](const SomeLanes& a, const SomeLanes& b) {
    return __builtin_shuffle(a, b, Index{0, 1, 4, 5, 8, 9, 12, 13}) +
           __builtin_shuffle(a, b, Index{2, 3, 6, 7, 10, 11, 14, 15});
  };
  return halves(halves(pairs(of[0], of[1]), pairs(of[2], of[3])), halves(pairs(of[4], of[5]), pairs(of[6], of[7])));
#endif
}

/// Square roots.
TALUS_HD inline Lanes roots(const Lanes& a) {
#if defined(__CUDACC__)
  return Lanes::each([&](int i) { return std::sqrt(a[i]); });
#elif defined(TALUS_LANE_HALVES) && !defined(TALUS_MIXED_PRECISION)
  return {LaneHalves::Half(_mm256_sqrt_pd(__m256d(a.low))), LaneHalves::Half(_mm256_sqrt_pd(__m256d(a.high)))};
#elif defined(__AVX512F__) && !defined(TALUS_MIXED_PRECISION)
  return Lanes(_mm512_maskz_sqrt_pd(0xff, __m512d(a)));
#elif defined(__AVX__) && defined(TALUS_MIXED_PRECISION)
  return Lanes(_mm256_sqrt_ps(__m256(a)));
#else
  Lanes result;
  for (int i = 0; i < kLanes; ++i) result[i] = std::sqrt(a[i]);
  return result;
#endif
}

/// The first lane in all.
TALUS_HD inline Lanes first_lane(const Lanes& a) { return every_lane<Lanes>(a[0]); }

}  // namespace dem_gpu
