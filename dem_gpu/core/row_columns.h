// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/row_quads.h"

// Entries of columns, those of one row or of one a lane: what is written for a template parameter Row takes an int or
// RowLanes.

namespace dem_gpu {

/// What an entry of a column of Reals becomes.
template <class Row>
using NumberOf = std::conditional_t<std::is_same_v<Row, int>, Real, RealLanes>;

/// number(i) in lane i.
template <class Value>
TALUS_HD inline RealLanes lanes_of(const Value& number) {
#if defined(__CUDACC__)
  return number(0);
#elif defined(TALUS_AVX512)
  return RealLanes{number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)};
#elif defined(TALUS_AVX)
  return RealLanes{number(0), number(1), number(2), number(3)};
#else
  return RealLanes{number(0), number(1)};
#endif
}

/// vector(i), a reference into a column, in lane i.
template <class Value>
TALUS_HD inline Vector3<RealLanes> vectors_of(const Value& vector) {
#if defined(TALUS_AVX512)
  constexpr __mmask8 kOfVector = 0x7;
  return turned_rows([&](int i) { return _mm256_maskz_loadu_pd(kOfVector, &vector(i).x); }).vector;
#elif defined(TALUS_AVX)
  const __m256i of_vector = _mm256_setr_epi64x(-1, -1, -1, 0);
  return turned_rows([&](int i) { return _mm256_maskload_pd(&vector(i).x, of_vector); }).vector;
#else
  return {lanes_of([&](int i) { return vector(i).x; }), lanes_of([&](int i) { return vector(i).y; }),
          lanes_of([&](int i) { return vector(i).z; })};
#endif
}

template <class Value>
TALUS_HD inline BasicQuaternion<RealLanes> quaternions_of(const Value& quaternion) {
#if defined(TALUS_AVX512) || defined(TALUS_AVX)
  const Quad<RealLanes> wxyz = turned_rows([&](int i) { return _mm256_loadu_pd(&quaternion(i).w); });
  return {wxyz.vector.x, wxyz.vector.y, wxyz.vector.z, wxyz.number};
#else
  return {lanes_of([&](int i) { return quaternion(i).w; }), lanes_of([&](int i) { return quaternion(i).x; }),
          lanes_of([&](int i) { return quaternion(i).y; }), lanes_of([&](int i) { return quaternion(i).z; })};
#endif
}

/// Lane i to vector(i), a reference into a column.
template <class Entry>
TALUS_HD inline void store_vectors(const Vector3<RealLanes>& values, const Entry& vector) {
#if defined(TALUS_AVX512) || defined(TALUS_AVX)
  turn_to_rows({values, RealLanes{}}, [&](int i, const __m256d& row) {
    Real* const numbers = &vector(i).x;
    _mm_storeu_pd(numbers, _mm256_castpd256_pd128(row));
    _mm_store_sd(numbers + 2, _mm256_extractf128_pd(row, 1));
  });
#else
  for (int i = 0; i < kRealLanes; ++i) vector(i) = lane(values, i);
#endif
}

/// `column`: a pointer or a RowField.
template <class Column>
TALUS_HD inline auto gather(const Column& column, int row) {
  return column[row];
}
template <class Column>
TALUS_HD inline auto gather(const Column& column, const RowLanes& rows) {
  using Entry = std::remove_cvref_t<decltype(column[0])>;
  const auto entry = [&](int i) -> const Entry& { return column[rows[i]]; };
  if constexpr (std::is_same_v<Entry, Real>)
    return lanes_of(entry);
  else if constexpr (std::is_same_v<Entry, Quaternion>)
    return quaternions_of(entry);
  else
    return vectors_of(entry);
}

template <class Column, class Entry>
TALUS_HD inline void scatter(const Column& column, int row, const Entry& entry) {
  column[row] = entry;
}
/// Rows named by several lanes must get the same from each.
template <class Column>
TALUS_HD inline void scatter(const Column& column, const RowLanes& rows, const RealLanes& numbers) {
  for (int i = 0; i < kRealLanes; ++i) column[rows[i]] = lane(numbers, i);
}
template <class Column>
TALUS_HD inline void scatter(const Column& column, const RowLanes& rows, const Vector3<RealLanes>& vectors) {
  store_vectors(vectors, [&](int i) -> Vec3& { return column[rows[i]]; });
}

}  // namespace dem_gpu
