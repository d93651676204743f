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

/// For the small functions of contact geometry. On the CPU a call would pass their vectors through memory. On the GPU
/// their lanes are loops, many times as long once unrolled: called, kernels stay small (inlined, one took nvcc
/// minutes).
#if defined(__CUDACC__)
#define TALUS_INLINE inline __attribute__((noinline))
#else
#define TALUS_INLINE inline __attribute__((always_inline))
#endif

/// On the GPU a call of its own, so that kernels do not hold several copies of it: the large functions of contact
/// geometry. On the CPU the compiler chooses.
#if defined(__CUDACC__)
#define TALUS_DEVICE_CALL __attribute__((noinline))
#else
#define TALUS_DEVICE_CALL
#endif

/// All that a function calls becomes part of it: wide vectors that go through memory from call to call cost more than
/// the work on them.
#if defined(__CUDACC__)
#define TALUS_ALL_INLINED
#else
#define TALUS_ALL_INLINED __attribute__((flatten))
#endif

/// The loop that follows becomes straight code, so that what it indexes can stay in registers.
#if defined(__CUDACC__)
#define TALUS_UNROLL _Pragma("unroll")
#else
#define TALUS_UNROLL _Pragma("GCC unroll 8")
#endif
