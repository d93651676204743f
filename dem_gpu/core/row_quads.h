// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/vec3_lanes.h"

// Rows of a table whose members are quads, a vector and a number each: several rows are read as wide as registers are
// and turned, one register a component, for a third of the instructions of a column after the other.

namespace dem_gpu {

template <class Number>
struct Quad {
  Vector3<Number> vector;
  Number number;
};

template <class Row>
inline constexpr bool kIsOfQuads = sizeof(Row) % (4 * sizeof(Real)) == 0;

template <class Row>
TALUS_HD inline const Real* quad_of(const Row* rows, const RowLanes& lanes, int i, int quad) {
  return reinterpret_cast<const Real*>(rows + lanes.row[i]) + 4 * quad;
}
template <class Row>
TALUS_HD inline Real* quad_of(Row* rows, const RowLanes& lanes, int i, int quad) {
  return reinterpret_cast<Real*>(rows + lanes.row[i]) + 4 * quad;
}

#if defined(TALUS_AVX512)

/// The forms without a mask read an undefined register in GCC 12's header, of which it warns itself (GCC bug 105593).
constexpr __mmask8 kAllLanes = 0xff;

/// Four numbers a lane, those of lane i as load(i) gives them (__m256d).
template <class Load>
inline Quad<RealLanes> turned_rows(const Load& load) {
  const auto rows_of = [&](int i) {
    return _mm512_maskz_insertf64x4(kAllLanes, _mm512_castpd256_pd512(load(i)), load(i + 4), 1);
  };
  const __m512d row_04 = rows_of(0), row_15 = rows_of(1), row_26 = rows_of(2), row_37 = rows_of(3);
  const __m512d xz_01 = _mm512_maskz_unpacklo_pd(kAllLanes, row_04, row_15),
                yw_01 = _mm512_maskz_unpackhi_pd(kAllLanes, row_04, row_15);
  const __m512d xz_23 = _mm512_maskz_unpacklo_pd(kAllLanes, row_26, row_37),
                yw_23 = _mm512_maskz_unpackhi_pd(kAllLanes, row_26, row_37);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const auto joined = [](const __m512d& first, const __m512i& order, const __m512d& second) {
    return (RealLanes)_mm512_permutex2var_pd(first, order, second);
  };
  return {{joined(xz_01, low, xz_23), joined(yw_01, low, yw_23), joined(xz_01, high, xz_23)},
          joined(yw_01, high, yw_23)};
}

/// And back: store(i, four numbers of lane i).
template <class Store>
inline void turn_to_rows(const Quad<RealLanes>& values, const Store& store) {
  const __m512d x = (__m512d)values.vector.x, y = (__m512d)values.vector.y, z = (__m512d)values.vector.z,
                w = (__m512d)values.number;
  const __m512d xy_even = _mm512_maskz_unpacklo_pd(kAllLanes, x, y), xy_odd = _mm512_maskz_unpackhi_pd(kAllLanes, x, y);
  const __m512d zw_even = _mm512_maskz_unpacklo_pd(kAllLanes, z, w), zw_odd = _mm512_maskz_unpackhi_pd(kAllLanes, z, w);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const auto store_two = [&](int i, const __m512d& two_rows) {
    store(i, __builtin_shufflevector(two_rows, two_rows, 0, 1, 2, 3));
    store(i + 4, _mm512_maskz_extractf64x4_pd(kAllLanes, two_rows, 1));
  };
  store_two(0, _mm512_permutex2var_pd(xy_even, low, zw_even));
  store_two(1, _mm512_permutex2var_pd(xy_odd, low, zw_odd));
  store_two(2, _mm512_permutex2var_pd(xy_even, high, zw_even));
  store_two(3, _mm512_permutex2var_pd(xy_odd, high, zw_odd));
}

#elif defined(TALUS_AVX)

/// Four numbers a lane, those of lane i as load(i) gives them (__m256d).
template <class Load>
inline Quad<RealLanes> turned_rows(const Load& load) {
  const __m256d row_0 = load(0), row_1 = load(1), row_2 = load(2), row_3 = load(3);
  const __m256d xz_01 = _mm256_unpacklo_pd(row_0, row_1), yw_01 = _mm256_unpackhi_pd(row_0, row_1);
  const __m256d xz_23 = _mm256_unpacklo_pd(row_2, row_3), yw_23 = _mm256_unpackhi_pd(row_2, row_3);
  return {{(RealLanes)_mm256_permute2f128_pd(xz_01, xz_23, 0x20), (RealLanes)_mm256_permute2f128_pd(yw_01, yw_23, 0x20),
           (RealLanes)_mm256_permute2f128_pd(xz_01, xz_23, 0x31)},
          (RealLanes)_mm256_permute2f128_pd(yw_01, yw_23, 0x31)};
}

/// And back: store(i, four numbers of lane i).
template <class Store>
inline void turn_to_rows(const Quad<RealLanes>& values, const Store& store) {
  const __m256d x = (__m256d)values.vector.x, y = (__m256d)values.vector.y, z = (__m256d)values.vector.z,
                w = (__m256d)values.number;
  const __m256d xy_even = _mm256_unpacklo_pd(x, y), xy_odd = _mm256_unpackhi_pd(x, y);
  const __m256d zw_even = _mm256_unpacklo_pd(z, w), zw_odd = _mm256_unpackhi_pd(z, w);
  store(0, _mm256_permute2f128_pd(xy_even, zw_even, 0x20));
  store(1, _mm256_permute2f128_pd(xy_odd, zw_odd, 0x20));
  store(2, _mm256_permute2f128_pd(xy_even, zw_even, 0x31));
  store(3, _mm256_permute2f128_pd(xy_odd, zw_odd, 0x31));
}

#endif

#if defined(TALUS_AVX512) || defined(TALUS_AVX)

template <class Row>
inline Quad<RealLanes> gather_quad(const Row* rows, const RowLanes& lanes, int quad) {
  static_assert(kIsOfQuads<Row>);
  return turned_rows([&](int i) { return _mm256_loadu_pd(quad_of(rows, lanes, i, quad)); });
}

template <class Row>
inline void scatter_quad(Row* rows, const RowLanes& lanes, int quad, const Quad<RealLanes>& values) {
  static_assert(kIsOfQuads<Row>);
  turn_to_rows(values, [&](int i, const __m256d& row) { _mm256_storeu_pd(quad_of(rows, lanes, i, quad), row); });
}

#else

template <class Row>
TALUS_HD inline Quad<RealLanes> gather_quad(const Row* rows, const RowLanes& lanes, int quad) {
  static_assert(kIsOfQuads<Row>);
  Quad<RealLanes> values;
  for (int i = 0; i < kRealLanes; ++i) {
    const Real* numbers = quad_of(rows, lanes, i, quad);
    lane(values.vector.x, i) = numbers[0];
    lane(values.vector.y, i) = numbers[1];
    lane(values.vector.z, i) = numbers[2];
    lane(values.number, i) = numbers[3];
  }
  return values;
}

template <class Row>
TALUS_HD inline void scatter_quad(Row* rows, const RowLanes& lanes, int quad, const Quad<RealLanes>& values) {
  static_assert(kIsOfQuads<Row>);
  for (int i = 0; i < kRealLanes; ++i) {
    Real* numbers = quad_of(rows, lanes, i, quad);
    numbers[0] = lane(values.vector.x, i);
    numbers[1] = lane(values.vector.y, i);
    numbers[2] = lane(values.vector.z, i);
    numbers[3] = lane(values.number, i);
  }
}

#endif

/// Sum of quads, one after the other.
class QuadSum {
 public:
  TALUS_HD explicit QuadSum(const Vec3& start) : sum_{start.x, start.y, start.z, 0} {}

#if defined(__CUDACC__)
  TALUS_HD void add(const Real* quad, Real factor) {
    for (int i = 0; i < 3; ++i) sum_[i] += factor * quad[i];
  }

 private:
  Real sum_[4];
#else
  void add(const Real* quad, Real factor) {
    Numbers numbers;
    __builtin_memcpy(&numbers, quad, sizeof(numbers));
    sum_ += factor * numbers;
  }

 private:
  using Numbers = Real __attribute__((vector_size(4 * sizeof(Real))));
  Numbers sum_;
#endif

 public:
  TALUS_HD Vec3 vector() const { return {sum_[0], sum_[1], sum_[2]}; }
  /// Number by number: a vector put together elsewhere is copied in wider pieces than it was written in, for which
  /// processors wait.
  TALUS_HD void store(Vec3& to) const {
    to.x = sum_[0];
    to.y = sum_[1];
    to.z = sum_[2];
  }
};

}  // namespace dem_gpu
