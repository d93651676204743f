// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/intrinsics.h"
#include "dem_gpu/core/real_lanes.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Rows of columns, one a lane.
struct RowLanes {
  std::int64_t row[kRealLanes];
  std::int64_t vector[kRealLanes];  // where a Vec3 column has the row, in numbers

  TALUS_HD void set(int i, int to) {
    row[i] = to;
    vector[i] = 3 * static_cast<std::int64_t>(to);
  }
  TALUS_HD int operator[](int i) const { return static_cast<int>(row[i]); }
};

TALUS_HD inline RealLanes gather(const Real* column, const RowLanes& rows) {
  RealLanes values;
  for (int i = 0; i < kRealLanes; ++i) lane(values, i) = column[rows.row[i]];
  return values;
}
TALUS_HD inline void scatter(Real* column, const RowLanes& rows, const RealLanes& values) {
  for (int i = 0; i < kRealLanes; ++i) column[rows.row[i]] = lane(values, i);
}

TALUS_HD inline Vec3 lane(const Vector3<RealLanes>& v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }

#if defined(TALUS_AVX512)

/// The forms without a mask read an undefined register in GCC 12's header, of which it warns itself (GCC bug 105593).
constexpr __mmask8 kAllLanes = 0xff;
inline __m128d first_two(__m512d a) { return __builtin_shufflevector(a, a, 0, 1); }

/// Rows are loaded whole and turned in registers: a third of the instructions of single loads.
inline Vector3<RealLanes> gather(const Vec3* column, const RowLanes& rows) {
  const auto row = [&](int i) { return _mm256_maskz_loadu_pd(0x7, &column->x + rows.vector[i]); };
  const auto rows_of = [&](int i) {
    return _mm512_maskz_insertf64x4(kAllLanes, _mm512_castpd256_pd512(row(i)), row(i + 4), 1);
  };
  const __m512d row_04 = rows_of(0), row_15 = rows_of(1), row_26 = rows_of(2), row_37 = rows_of(3);
  const __m512d xz_01 = _mm512_maskz_unpacklo_pd(kAllLanes, row_04, row_15),
                y_01 = _mm512_maskz_unpackhi_pd(kAllLanes, row_04, row_15);
  const __m512d xz_23 = _mm512_maskz_unpacklo_pd(kAllLanes, row_26, row_37),
                y_23 = _mm512_maskz_unpackhi_pd(kAllLanes, row_26, row_37);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  return {(RealLanes)_mm512_permutex2var_pd(xz_01, low, xz_23), (RealLanes)_mm512_permutex2var_pd(y_01, low, y_23),
          (RealLanes)_mm512_permutex2var_pd(xz_01, high, xz_23)};
}

inline void scatter(Vec3* column, const RowLanes& rows, const Vector3<RealLanes>& values) {
  const __m512d x = (__m512d)values.x, y = (__m512d)values.y, z = (__m512d)values.z;
  const __m512d even = _mm512_maskz_unpacklo_pd(kAllLanes, x, y), odd = _mm512_maskz_unpackhi_pd(kAllLanes, x, y);
  const auto store = [&](int i, __m128d xy_even, __m128d xy_odd, __m128d z_both) {
    Real* const row_even = &column->x + rows.vector[i];
    Real* const row_odd = &column->x + rows.vector[i + 1];
    _mm_storeu_pd(row_even, xy_even);
    _mm_storel_pd(row_even + 2, z_both);
    _mm_storeu_pd(row_odd, xy_odd);
    _mm_storeh_pd(row_odd + 2, z_both);
  };
  store(0, first_two(even), first_two(odd), first_two(z));
  store(2, _mm512_maskz_extractf64x2_pd(kAllLanes, even, 1), _mm512_maskz_extractf64x2_pd(kAllLanes, odd, 1),
        _mm512_maskz_extractf64x2_pd(kAllLanes, z, 1));
  store(4, _mm512_maskz_extractf64x2_pd(kAllLanes, even, 2), _mm512_maskz_extractf64x2_pd(kAllLanes, odd, 2),
        _mm512_maskz_extractf64x2_pd(kAllLanes, z, 2));
  store(6, _mm512_maskz_extractf64x2_pd(kAllLanes, even, 3), _mm512_maskz_extractf64x2_pd(kAllLanes, odd, 3),
        _mm512_maskz_extractf64x2_pd(kAllLanes, z, 3));
}

#elif defined(TALUS_AVX)

inline Vector3<RealLanes> gather(const Vec3* column, const RowLanes& rows) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const auto row = [&](int i) { return _mm256_maskload_pd(&column->x + rows.vector[i], three); };
  const __m256d row_0 = row(0), row_1 = row(1), row_2 = row(2), row_3 = row(3);
  const __m256d xz_01 = _mm256_unpacklo_pd(row_0, row_1), y_01 = _mm256_unpackhi_pd(row_0, row_1);
  const __m256d xz_23 = _mm256_unpacklo_pd(row_2, row_3), y_23 = _mm256_unpackhi_pd(row_2, row_3);
  return {(RealLanes)_mm256_permute2f128_pd(xz_01, xz_23, 0x20), (RealLanes)_mm256_permute2f128_pd(y_01, y_23, 0x20),
          (RealLanes)_mm256_permute2f128_pd(xz_01, xz_23, 0x31)};
}

inline void scatter(Vec3* column, const RowLanes& rows, const Vector3<RealLanes>& values) {
  const __m256d x = (__m256d)values.x, y = (__m256d)values.y, z = (__m256d)values.z;
  const __m256d even = _mm256_unpacklo_pd(x, y), odd = _mm256_unpackhi_pd(x, y);
  const auto store = [&](int i, __m128d xy_even, __m128d xy_odd, __m128d z_both) {
    Real* const row_even = &column->x + rows.vector[i];
    Real* const row_odd = &column->x + rows.vector[i + 1];
    _mm_storeu_pd(row_even, xy_even);
    _mm_storel_pd(row_even + 2, z_both);
    _mm_storeu_pd(row_odd, xy_odd);
    _mm_storeh_pd(row_odd + 2, z_both);
  };
  store(0, _mm256_castpd256_pd128(even), _mm256_castpd256_pd128(odd), _mm256_castpd256_pd128(z));
  store(2, _mm256_extractf128_pd(even, 1), _mm256_extractf128_pd(odd, 1), _mm256_extractf128_pd(z, 1));
}

#else

TALUS_HD inline Vector3<RealLanes> gather(const Vec3* column, const RowLanes& rows) {
  Vector3<RealLanes> values;
  for (int i = 0; i < kRealLanes; ++i) {
    const Vec3& row = column[rows.row[i]];
    lane(values.x, i) = row.x;
    lane(values.y, i) = row.y;
    lane(values.z, i) = row.z;
  }
  return values;
}
TALUS_HD inline void scatter(Vec3* column, const RowLanes& rows, const Vector3<RealLanes>& values) {
  for (int i = 0; i < kRealLanes; ++i) column[rows.row[i]] = lane(values, i);
}

#endif

}  // namespace dem_gpu
