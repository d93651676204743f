// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

// Ask for the line of a cache that an address lies in, which will be needed soon. On the GPU other threads hide the
// wait.

/// What several threads read stays with all of them.
TALUS_HD inline void prefetch_to_read([[maybe_unused]] const void* address) {
#if !defined(__CUDACC__)
  __builtin_prefetch(address, 0);
#endif
}

TALUS_HD inline void prefetch_to_write([[maybe_unused]] const void* address) {
#if !defined(__CUDACC__)
  __builtin_prefetch(address, 1);
#endif
}

}  // namespace dem_gpu
