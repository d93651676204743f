// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks a function that runs on host and device.
#if defined(__CUDACC__)
#define TALUS_HD __host__ __device__
#else
#define TALUS_HD
#endif

/// One compiled copy: inlined into kernels of different templates, the same source may contract different products and
/// sums, and round differently.
#define TALUS_ONE_COPY __attribute__((noinline))

/// For the small functions of contact geometry: a call would pass their vectors through memory.
#define TALUS_INLINE inline __attribute__((always_inline))
