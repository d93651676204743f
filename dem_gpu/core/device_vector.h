// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/copy.h>
#include <thrust/device_vector.h>

#include <span>
#include <vector>

#ifdef TALUS_BACKEND_CUDA
#include "dem_gpu/core/device_stream.h"
#endif

namespace dem_gpu {

/// Waits for all that has been launched; throws std::runtime_error where some of it failed.
inline void wait_for_launches() {
#ifdef TALUS_BACKEND_CUDA
  wait_for_device();
#endif
}

/// A column: memory of the device the engine runs on (host memory with the CPU back ends).
template <class T>
using DeviceVector = thrust::device_vector<T>;

template <class T>
T* pointer(DeviceVector<T>& column) {
  return thrust::raw_pointer_cast(column.data());
}
template <class T>
const T* pointer(const DeviceVector<T>& column) {
  return thrust::raw_pointer_cast(column.data());
}

template <class T>
std::vector<T> to_host(const DeviceVector<T>& column) {
  wait_for_launches();
  std::vector<T> values(column.size());
  thrust::copy(column.begin(), column.end(), values.begin());
  return values;
}

template <class T>
void assign(DeviceVector<T>& column, std::span<const T> values) {
  column.resize(values.size());
  thrust::copy(values.begin(), values.end(), column.begin());
}
template <class T>
void assign(DeviceVector<T>& column, const std::vector<T>& values) {
  assign(column, std::span<const T>(values));
}

/// The same, of values that launches of before may still read: the host does not wait for them. `values` may change
/// once this returns.
template <class T>
void assign_launched(DeviceVector<T>& column, const std::vector<T>& values) {
#ifdef TALUS_BACKEND_CUDA
  if (column.size() == values.size()) {
    // The driver copies up to 64 KiB of ordinary memory aside and returns; of more it waits for what was launched.
    if (!values.empty())
      check_device(cudaMemcpyAsync(pointer(column), values.data(), values.size() * sizeof(T), cudaMemcpyHostToDevice,
                                   device_stream()),
                   "writing a column");
    return;
  }
#endif
  assign(column, values);
}

}  // namespace dem_gpu
