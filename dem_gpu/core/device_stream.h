// SPDX-License-Identifier: Apache-2.0
#pragma once

// CUDA back end alone: where its work is launched, and what launches without waiting need.

#include <cuda_runtime.h>

#include <cstddef>

namespace dem_gpu {

/// All work of a host thread goes to one stream, one piece after the other. What reads or writes a column from the host
/// (to_host, assign, single elements) goes to the legacy stream, which waits for this one and this one for it.
inline cudaStream_t device_stream() { return cudaStreamPerThread; }

/// Throws std::runtime_error with CUDA's name for the fault, what it means and `doing`.
void check_device(cudaError_t status, const char* doing);

/// Waits for what has been launched, and throws where something of it failed.
void wait_for_device();

/// Memory for sorts, scans and reductions, kept from call to call: what one gives back the next one takes. Its work
/// comes later in the stream, so nobody waits. One per host thread, as the stream is.
class TemporaryStorage {
 public:
  using value_type = char;
  char* allocate(std::ptrdiff_t bytes);
  void deallocate(char* block, std::size_t bytes);
};
TemporaryStorage& temporary_storage();

}  // namespace dem_gpu
