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

/// All that a function calls becomes part of it: wide vectors that go through memory from call to call cost more than
/// the work on them.
#if defined(__CUDACC__)
#define TALUS_ALL_INLINED
#else
#define TALUS_ALL_INLINED __attribute__((flatten))
#endif
