// SPDX-License-Identifier: Apache-2.0
#pragma once

// The only place that names an execution policy. Every function gives the same result whatever the number of threads.

#include <thrust/execution_policy.h>
#include <thrust/extrema.h>
#include <thrust/fill.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

/// kernel(i) for i in [first, last), in any order.
template <class Kernel>
void parallel_for(int first, int last, const Kernel& kernel) {
  if (first < last)
    thrust::for_each(thrust::device, thrust::counting_iterator<int>(first), thrust::counting_iterator<int>(last),
                     kernel);
}

template <class T>
void fill(DeviceVector<T>& column, const T& value) {
  thrust::fill(thrust::device, column.begin(), column.end(), value);
}

template <class T>
void sort(DeviceVector<T>& keys) {
  thrust::sort(thrust::device, keys.begin(), keys.end());
}

template <class K, class V>
void sort_by_key(DeviceVector<K>& keys, DeviceVector<V>& values) {
  thrust::stable_sort_by_key(thrust::device, keys.begin(), keys.end(), values.begin());
}

/// counts[i] becomes the sum of all before i; returns the total. `counts` has one entry more than items.
inline int exclusive_scan(DeviceVector<int>& counts) {
  thrust::exclusive_scan(thrust::device, counts.begin(), counts.end(), counts.begin());
  return counts.empty() ? 0 : static_cast<int>(counts.back());
}

/// Largest entry; `empty_value` for an empty column.
template <class T>
T max_of(const DeviceVector<T>& column, T empty_value) {
  if (column.empty()) return empty_value;
  return *thrust::max_element(thrust::device, column.begin(), column.end());
}
template <class T>
T min_of(const DeviceVector<T>& column, T empty_value) {
  if (column.empty()) return empty_value;
  return *thrust::min_element(thrust::device, column.begin(), column.end());
}

/// First index in the ascending array whose entry is not less than `value`.
template <class T>
TALUS_HD inline int lower_bound(const T* ascending, int count, const T& value) {
  int first = 0;
  while (count > 0) {
    const int half = count / 2;
    if (ascending[first + half] < value) {
      first += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return first;
}

}  // namespace dem_gpu
