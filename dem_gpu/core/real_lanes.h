// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"
// Built-in functions of the compiler, not its header: the scene's laws are written for Numbers, and what includes a
// scene shall not get thousands of names with it.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define TALUS_AVX512 1
#elif defined(__AVX__)
#define TALUS_AVX 1
#endif
#endif

// Several contacts or bodies worked on together: one vector register on the CPU, a single number on the GPU, where the
// threads are the lanes. What is written for a template parameter Number takes a Real or RealLanes; every lane is
// rounded alike, wherever in the register it lies.

namespace dem_gpu {

TALUS_HD inline float square_root(float a) { return std::sqrt(a); }
TALUS_HD inline Real square_root(Real a) { return std::sqrt(a); }
TALUS_HD inline Real magnitude(Real a) { return std::abs(a); }
TALUS_HD inline Real smaller(Real a, Real b) { return a < b ? a : b; }
TALUS_HD inline Real larger(Real a, Real b) { return a > b ? a : b; }
TALUS_HD inline Real select(bool is_first, Real first, Real second) { return is_first ? first : second; }
TALUS_HD inline unsigned bits_of(bool is_true) { return is_true ? 1 : 0; }

#if defined(__CUDACC__)

inline constexpr int kRealLanes = 1;
using RealLanes = Real;
TALUS_HD inline Real& lane(RealLanes& a, int /*i*/) { return a; }
TALUS_HD inline Real lane(const RealLanes& a, int /*i*/) { return a; }
TALUS_HD inline RealLanes load_lanes_at(const Real* values) { return *values; }
TALUS_HD inline std::int64_t load_lanes_at(const std::int64_t* values) { return *values; }
TALUS_HD inline void store_lanes_at(const RealLanes& a, Real* values) { *values = a; }

#else

#if defined(TALUS_AVX512)
inline constexpr int kRealLanes = 8;
#elif defined(TALUS_AVX)
inline constexpr int kRealLanes = 4;
#else
inline constexpr int kRealLanes = 2;
#endif
using RealLanes = Real __attribute__((vector_size(kRealLanes * sizeof(Real))));
using LaneMask = decltype(RealLanes{} < RealLanes{});
using KeyLanes = std::int64_t __attribute__((vector_size(kRealLanes * sizeof(std::int64_t))));
using LongLanes = long long __attribute__((vector_size(kRealLanes * sizeof(long long))));

inline RealLanes select(const LaneMask& mask, const RealLanes& first, const RealLanes& second) {
  return mask ? first : second;
}
inline RealLanes magnitude(const RealLanes& a) { return a < 0.0 ? -a : a; }
inline RealLanes smaller(const RealLanes& a, const RealLanes& b) { return a < b ? a : b; }
inline RealLanes larger(const RealLanes& a, const RealLanes& b) { return a > b ? a : b; }
// By address: GCC 12 reads the wrong lane of a constant vector under -fsanitize=undefined where the index varies.
inline Real& lane(RealLanes& a, int i) { return reinterpret_cast<Real*>(&a)[i]; }
inline Real lane(const RealLanes& a, int i) { return reinterpret_cast<const Real*>(&a)[i]; }
inline RealLanes load_lanes_at(const Real* values) {
  RealLanes lanes;
  __builtin_memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}
inline KeyLanes load_lanes_at(const std::int64_t* values) {
  KeyLanes lanes;
  __builtin_memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}
inline void store_lanes_at(const RealLanes& a, Real* values) { __builtin_memcpy(values, &a, sizeof(a)); }

inline RealLanes square_root(const RealLanes& a) {
#if defined(TALUS_AVX512)
  constexpr int kCurrentRounding = 4;
  return __builtin_ia32_sqrtpd512_mask(a, a, static_cast<char>(-1), kCurrentRounding);
#elif defined(TALUS_AVX)
  return __builtin_ia32_sqrtpd256(a);
#else
  RealLanes roots;
  for (int i = 0; i < kRealLanes; ++i) roots[i] = std::sqrt(a[i]);
  return roots;
#endif
}

/// Bit i for lane i where the mask is set.
inline unsigned bits_of(const LaneMask& mask) {
#if defined(TALUS_AVX512)
  return static_cast<unsigned char>(__builtin_ia32_cvtq2mask512((LongLanes)mask));
#elif defined(TALUS_AVX)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256((RealLanes)mask));
#elif defined(__SSE2__) && !defined(__clang__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd((RealLanes)mask));
#else
  long long lanes[kRealLanes];
  __builtin_memcpy(lanes, &mask, sizeof(lanes));
  unsigned bits = 0;
  for (int i = 0; i < kRealLanes; ++i) bits |= (lanes[i] != 0 ? 1u : 0u) << i;
  return bits;
#endif
}

#endif

}  // namespace dem_gpu
