// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/intrinsics.h"
#include "dem_gpu/core/real_lanes.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Rows of columns, one a lane.
struct RowLanes {
  int row[kRealLanes];

  TALUS_HD int operator[](int i) const { return row[i]; }
  TALUS_HD static RowLanes load(const int* rows) {
    RowLanes lanes;
    for (int i = 0; i < kRealLanes; ++i) lanes.row[i] = rows[i];
    return lanes;
  }
};

/// Writes those lanes whose bit is set, one after the other; may write as far as all of them would.
TALUS_HD inline void append_lanes(const RowLanes& lanes, unsigned which, int* to) {
#if defined(TALUS_AVX512)
  const __m256i rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lanes.row));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(static_cast<__mmask8>(which), rows));
#else
  for (int i = 0; i < kRealLanes; ++i) {
    *to = lanes.row[i];
    to += which >> i & 1;
  }
#endif
}

TALUS_HD inline Vec3 lane(const Vector3<RealLanes>& v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }

}  // namespace dem_gpu
