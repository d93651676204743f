// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

/// Launches written down with all their arguments, to be made again: what a CUDA graph holds, on the CPU.
using LaunchList = std::vector<std::function<void()>>;

/// Stands before the kernels of one pass of one step in a block of steps (steps/step_loop.h): closed once the block has
/// been halted at a place before them, so that they do nothing. A pass that is run by itself has an open gate.
/// Places count the passes of all steps of a block.
struct Gate {
  int* halted_at = nullptr;  // on the device: place from which on nothing is done; null: always open
  int place = 0;             // of the pass
  int list_place = 0;        // of the pass of the same step that renews the neighbour list
#ifndef TALUS_BACKEND_CUDA
  LaunchList* record = nullptr;  // where launches are written down instead of made
#endif

  TALUS_HD bool is_closed() const { return halted_at && *halted_at <= place; }
};

/// Sets a flag on the device that others may set to the same value at the same time.
TALUS_HD inline void raise(int* flag, int value) {
#if defined(__CUDA_ARCH__)
  *static_cast<volatile int*>(flag) = value;
#else
  __atomic_store_n(flag, value, __ATOMIC_RELAXED);
#endif
}

}  // namespace dem_gpu
