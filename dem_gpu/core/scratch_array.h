// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <new>

#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

/// Local array of a kernel that is not cleared: entries must be written before they are read. (Clearing the polygon
/// buffers cost more than clipping into them.)
template <class T, int N>
class ScratchArray {
 public:
  TALUS_HD T& operator[](int i) {
    return *std::launder(reinterpret_cast<T*>(bytes_ + sizeof(T) * static_cast<unsigned>(i)));
  }
  TALUS_HD const T& operator[](int i) const {
    return *std::launder(reinterpret_cast<const T*>(bytes_ + sizeof(T) * static_cast<unsigned>(i)));
  }
  TALUS_HD T* data() { return reinterpret_cast<T*>(bytes_); }
  TALUS_HD const T* data() const { return reinterpret_cast<const T*>(bytes_); }

 private:
  alignas(T) unsigned char bytes_[sizeof(T) * static_cast<unsigned>(N)];
};

}  // namespace dem_gpu
