// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

// A block of numbers of contact geometry worked on together: one vector register on the CPU (the compiler splits it
// where registers are shorter), a single number on the GPU, where the threads are the lanes. Measured on pairs of
// 24-vertex parts, plain loops were not vectorised by GCC 12 and took four times as long.

namespace dem_gpu {

TALUS_HD inline int count_bits(std::uint64_t bits) {
#if defined(__CUDA_ARCH__)
  return __popcll(bits);
#else
  return __builtin_popcountll(bits);
#endif
}

#if defined(__CUDACC__)

inline constexpr int kLanes = 1;
using Lanes = LocalReal;
using LaneBits = std::uint64_t;

TALUS_HD inline Lanes load_lanes(const LocalReal* values) { return *values; }
TALUS_HD inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
TALUS_HD inline Lanes greatest(Lanes a, Lanes b) { return a > b ? a : b; }
TALUS_HD inline LocalReal least_lane(Lanes a) { return a; }
TALUS_HD inline LocalReal greatest_lane(Lanes a) { return a; }
TALUS_HD inline LaneBits bits_above(Lanes a, LocalReal limit, int first) {
  return a > limit ? LaneBits{1} << first : 0;
}
TALUS_HD inline std::uint64_t join(LaneBits bits) { return bits; }

#else

inline constexpr int kLanes = 8;
using Lanes = LocalReal __attribute__((vector_size(kLanes * sizeof(LocalReal))));
using LaneBits = std::uint64_t __attribute__((vector_size(kLanes * sizeof(std::uint64_t))));

inline Lanes load_lanes(const LocalReal* values) {
  Lanes lanes;
  __builtin_memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}
inline Lanes least(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes greatest(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline LocalReal least_lane(const Lanes& a) {
  LocalReal value = a[0];
  for (int lane = 1; lane < kLanes; ++lane) value = a[lane] < value ? a[lane] : value;
  return value;
}
inline LocalReal greatest_lane(const Lanes& a) {
  LocalReal value = a[0];
  for (int lane = 1; lane < kLanes; ++lane) value = a[lane] > value ? a[lane] : value;
  return value;
}
/// Bit first + lane for each lane above the limit.
inline LaneBits bits_above(const Lanes& a, LocalReal limit, int first) {
  constexpr LaneBits kBit = {1, 2, 4, 8, 16, 32, 64, 128};
  return __builtin_convertvector(a > limit, LaneBits) & (kBit << first);
}
inline std::uint64_t join(const LaneBits& bits) {
  std::uint64_t all = bits[0];
  for (int lane = 1; lane < kLanes; ++lane) all |= bits[lane];
  return all;
}

#endif

}  // namespace dem_gpu
