// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks a function that runs on host and device.
#if defined(__CUDACC__)
#define TALUS_HD __host__ __device__
#else
#define TALUS_HD
#endif
