// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/core/intrinsics.h"

// Eight doubles as two AVX registers. A vector type of eight would be kept in memory there, and permuted number by
// number.

namespace dem_gpu {

struct LaneHalves {
  using Half = double __attribute__((vector_size(32)));
  Half low, high;

  double operator[](int i) const { return i < 4 ? low[i & 3] : high[i & 3]; }

  friend LaneHalves operator+(const LaneHalves& a, const LaneHalves& b) { return {a.low + b.low, a.high + b.high}; }
  friend LaneHalves operator-(const LaneHalves& a, const LaneHalves& b) { return {a.low - b.low, a.high - b.high}; }
  friend LaneHalves operator*(const LaneHalves& a, const LaneHalves& b) { return {a.low * b.low, a.high * b.high}; }
  friend LaneHalves operator/(const LaneHalves& a, const LaneHalves& b) { return {a.low / b.low, a.high / b.high}; }
  friend LaneHalves operator+(const LaneHalves& a, double b) { return {a.low + b, a.high + b}; }
  friend LaneHalves operator-(const LaneHalves& a, double b) { return {a.low - b, a.high - b}; }
  friend LaneHalves operator-(double a, const LaneHalves& b) { return {a - b.low, a - b.high}; }
  friend LaneHalves operator*(const LaneHalves& a, double b) { return {a.low * b, a.high * b}; }
  friend LaneHalves operator*(double a, const LaneHalves& b) { return {a * b.low, a * b.high}; }
  friend LaneHalves operator-(const LaneHalves& a) { return {-a.low, -a.high}; }
  LaneHalves& operator+=(const LaneHalves& b) { return *this = *this + b; }
  LaneHalves& operator-=(const LaneHalves& b) { return *this = *this - b; }
  LaneHalves& operator*=(const LaneHalves& b) { return *this = *this * b; }
};

inline LaneHalves load_halves(const double* values) {
  return {LaneHalves::Half(_mm256_loadu_pd(values)), LaneHalves::Half(_mm256_loadu_pd(values + 4))};
}
inline void store_lanes(const LaneHalves& a, double* values) {
  _mm256_storeu_pd(values, __m256d(a.low));
  _mm256_storeu_pd(values + 4, __m256d(a.high));
}
inline LaneHalves least(const LaneHalves& a, const LaneHalves& b) {
  return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}
inline LaneHalves greatest(const LaneHalves& a, const LaneHalves& b) {
  return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
/// Bit i where a[i] > b[i].
inline unsigned lanes_above(const LaneHalves& a, const LaneHalves& b) {
  const auto above = [](const LaneHalves::Half& x, const LaneHalves::Half& y) {
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(__m256d(x), __m256d(y), _CMP_GT_OQ)));
  };
  return above(a.low, b.low) | above(a.high, b.high) << 4;
}
inline LaneHalves swapped_lanes(const LaneHalves& a, int distance) {
  if (distance == 4) return {a.high, a.low};
  using Index = std::int64_t __attribute__((vector_size(32)));
  const Index order = distance == 2 ? Index{2, 3, 0, 1} : Index{1, 0, 3, 2};
  return {__builtin_shuffle(a.low, order), __builtin_shuffle(a.high, order)};
}
inline LaneHalves next_lane(const LaneHalves& a) {
  using Index = std::int64_t __attribute__((vector_size(32)));
  return {__builtin_shuffle(a.low, a.high, Index{1, 2, 3, 4}), __builtin_shuffle(a.high, a.low, Index{1, 2, 3, 4})};
}

/// An order of lanes unpacked: numbers of pairs of floats within a half, and (sign bit) whether the lane comes from the
/// high half.
struct HalvesIndex {
  __m256i pairs_low, pairs_high;
  __m256d is_high_low, is_high_high;

  /// From eight bytes.
  explicit HalvesIndex(const std::uint8_t* order) {
    const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(order));
    const __m256i low = _mm256_cvtepu8_epi64(bytes), high = _mm256_cvtepu8_epi64(_mm_srli_si128(bytes, 4));
    pairs_low = pairs(low);
    pairs_high = pairs(high);
    is_high_low = _mm256_castsi256_pd(_mm256_slli_epi64(low, 61));
    is_high_high = _mm256_castsi256_pd(_mm256_slli_epi64(high, 61));
  }

 private:
  static __m256i pairs(__m256i lanes) {
    const __m256i twice = _mm256_add_epi64(lanes, lanes);
    return _mm256_add_epi64(_mm256_add_epi64(twice, _mm256_slli_epi64(twice, 32)),
                            _mm256_set1_epi64x(std::int64_t{1} << 32));
  }
};
inline LaneHalves in_order(const LaneHalves& a, const HalvesIndex& index) {
  const auto picked = [&](__m256i pairs, __m256d is_high) {
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_castpd_ps(__m256d(a.low)), pairs);
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_castpd_ps(__m256d(a.high)), pairs);
    return LaneHalves::Half(_mm256_blendv_pd(_mm256_castps_pd(low), _mm256_castps_pd(high), is_high));
  };
  return {picked(index.pairs_low, index.is_high_low), picked(index.pairs_high, index.is_high_high)};
}

/// Lane k: the sum of the lanes of `of[k]`; neighbours first.
inline LaneHalves sums_of_lanes(const LaneHalves (&of)[8]) {
  using Half = LaneHalves::Half;
  using Index = std::int64_t __attribute__((vector_size(32)));
  const auto pairs = [](const Half& a, const Half& b) {
    return __builtin_shuffle(a, b, Index{0, 4, 2, 6}) + __builtin_shuffle(a, b, Index{1, 5, 3, 7});
  };
  const auto fours = [](const Half& a, const Half& b) {
    return __builtin_shuffle(a, b, Index{0, 1, 4, 5}) + __builtin_shuffle(a, b, Index{2, 3, 6, 7});
  };
  const auto of_four = [&](const LaneHalves* four) {
    return fours(pairs(four[0].low, four[1].low), pairs(four[2].low, four[3].low)) +
           fours(pairs(four[0].high, four[1].high), pairs(four[2].high, four[3].high));
  };
  return {of_four(of), of_four(of + 4)};
}

}  // namespace dem_gpu
