// SPDX-License-Identifier: Apache-2.0
#pragma once

// The only place that names an execution policy. Every function gives the same result whatever the number of threads.
// On the GPU none waits for what it launches, but for those that return a number; a fault of a kernel shows where the
// host next reads or waits (core/device_stream.h).

#include <thrust/execution_policy.h>
#include <thrust/extrema.h>
#include <thrust/fill.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/gate.h"
#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

#ifdef TALUS_BACKEND_CUDA
inline constexpr int kFewItems = 0;
inline auto device_policy() { return thrust::cuda::par_nosync(temporary_storage()).on(device_stream()); }
#else
inline auto device_policy() { return thrust::device; }
/// Up to this many items are worked off by the calling thread: waking the others takes longer, by far where they share
/// their cores with other processes.
inline constexpr int kFewItems = 32;
#endif

/// The same, of ranges of items.
inline constexpr int kFewRanges = kFewItems > 0 ? 1 : 0;

/// call(policy): the calling thread alone for a few items, else the backend.
template <class Call>
decltype(auto) with_policy_for(std::size_t items, const Call& call) {
  if constexpr (kFewItems > 0) {
    if (items <= kFewItems) return call(thrust::seq);
  }
  return call(device_policy());
}

#if defined(TALUS_BACKEND_CUDA)
#if !defined(__CUDACC__)
#error "core/parallel.h launches kernels: with the CUDA back end what includes it is compiled by nvcc (LANGUAGE CUDA)"
#endif

/// Threads of a block: a warp for each of a multiprocessor's four schedulers. More would put a small scene, whose
/// kernels are bound by latency, on fewer multiprocessors; any kernel has registers enough.
inline constexpr int kBlockThreads = 128;

template <class Kernel>
__global__ void __launch_bounds__(kBlockThreads) run_kernel(const Kernel kernel, int first, int last, Gate gate) {
  if (gate.is_closed()) return;
  const int i = first + static_cast<int>(blockIdx.x * kBlockThreads + threadIdx.x);
  if (i < last) kernel(i);
}

/// kernel(i) for i in [first, last), in any order, where the gate is open. A kernel of our own, since thrust::for_each
/// gives a block 512 items.
template <class Kernel>
void parallel_for(int first, int last, const Kernel& kernel, const Gate& gate = {}) {
  if (first >= last) return;
  const unsigned blocks = static_cast<unsigned>(last - first - 1) / kBlockThreads + 1;
  run_kernel<<<blocks, kBlockThreads, 0, device_stream()>>>(kernel, first, last, gate);
  check_device(cudaGetLastError(), "launching a kernel");
}

#else

/// For a gate that has launches written down: launch(gate that has not) in the list.
template <class Launch>
void write_down(const Gate& gate, const Launch& launch) {
  Gate later = gate;
  later.record = nullptr;
  gate.record->push_back([launch, later] { launch(later); });
}

/// The launch itself: one copy of the kernel, whoever calls it.
template <class Kernel>
__attribute__((noinline)) void run_kernel(int first, int last, const Kernel& kernel) {
  if (last - first <= kFewItems) {
    for (int i = first; i < last; ++i) kernel(i);
    return;
  }
  if (first < last)
    thrust::for_each(thrust::device, thrust::counting_iterator<int>(first), thrust::counting_iterator<int>(last),
                     kernel);
}

/// kernel(i) for i in [first, last), in any order, where the gate is open.
template <class Kernel>
void parallel_for(int first, int last, const Kernel& kernel, const Gate& gate = {}) {
  if (gate.record)
    write_down(gate, [=](const Gate& later) { parallel_for(first, last, kernel, later); });
  else if (!gate.is_closed())
    run_kernel(first, last, kernel);
}

#endif

#if defined(TALUS_BACKEND_CUDA)
inline constexpr int kRangeLength = 1, kShortRange = 1;
#else
/// Long enough to fill vector registers, short enough to share out.
inline constexpr int kRangeLength = 256;
/// Of items that take long.
inline constexpr int kShortRange = 64;
#endif

template <int kLength, class Kernel>
struct RangeKernel {
  Kernel kernel;
  int first, last;

  TALUS_HD void operator()(int range) const {
    const int begin = first + range * kLength;
    kernel(begin, begin + kLength < last ? begin + kLength : last);
  }
};

template <int kLength = kRangeLength>
TALUS_HD int range_count(int items) {
  return (items + kLength - 1) / kLength;
}

#if defined(TALUS_BACKEND_CUDA)

/// kernel(i, j) for ranges [i, j) that cover [first, last), of up to kLength items, in any order, where the gate is
/// open.
template <int kLength = kRangeLength, class Kernel>
void parallel_for_ranges(int first, int last, const Kernel& kernel, const Gate& gate = {}) {
  parallel_for(0, range_count<kLength>(last - first), RangeKernel<kLength, Kernel>{kernel, first, last}, gate);
}

#else

template <int kLength, class Kernel>
__attribute__((noinline)) void run_ranges(int first, int last, const Kernel& kernel) {
  const int ranges = range_count<kLength>(last - first);
  const RangeKernel<kLength, Kernel> of_range{kernel, first, last};
  if (ranges <= kFewRanges)
    for (int i = 0; i < ranges; ++i) of_range(i);
  else
    thrust::for_each(thrust::device, thrust::counting_iterator<int>(0), thrust::counting_iterator<int>(ranges),
                     of_range);
}

/// kernel(i, j) for ranges [i, j) that cover [first, last), of up to kLength items, in any order, where the gate is
/// open.
template <int kLength = kRangeLength, class Kernel>
void parallel_for_ranges(int first, int last, const Kernel& kernel, const Gate& gate = {}) {
  if (gate.record)
    write_down(gate, [=](const Gate& later) { parallel_for_ranges<kLength>(first, last, kernel, later); });
  else if (!gate.is_closed())
    run_ranges<kLength>(first, last, kernel);
}

#endif

template <class T>
void fill(DeviceVector<T>& column, const T& value) {
  with_policy_for(column.size(), [&](auto policy) { thrust::fill(policy, column.begin(), column.end(), value); });
}

template <class T>
void sort(DeviceVector<T>& keys) {
  with_policy_for(keys.size(), [&](auto policy) { thrust::sort(policy, keys.begin(), keys.end()); });
}

template <class K, class V>
void sort_by_key(DeviceVector<K>& keys, DeviceVector<V>& values) {
  with_policy_for(keys.size(),
                  [&](auto policy) { thrust::stable_sort_by_key(policy, keys.begin(), keys.end(), values.begin()); });
}

/// counts[i] becomes the sum of all before i; returns the total. `counts` has one entry more than items.
inline int exclusive_scan(DeviceVector<int>& counts) {
  with_policy_for(counts.size(),
                  [&](auto policy) { thrust::exclusive_scan(policy, counts.begin(), counts.end(), counts.begin()); });
  return counts.empty() ? 0 : static_cast<int>(counts.back());
}

/// Largest entry; `empty_value` for an empty column.
template <class T>
T max_of(const DeviceVector<T>& column, T empty_value) {
  if (column.empty()) return empty_value;
  return with_policy_for(column.size(),
                         [&](auto policy) -> T { return *thrust::max_element(policy, column.begin(), column.end()); });
}
template <class T>
T min_of(const DeviceVector<T>& column, T empty_value) {
  if (column.empty()) return empty_value;
  return with_policy_for(column.size(),
                         [&](auto policy) -> T { return *thrust::min_element(policy, column.begin(), column.end()); });
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

// sort_into_rows: items [0, item_count) by their rows, row_of(item) in [0, row_count). `entries` (n_items) become
// row_entry of each, ascending, and row r has [first[r], first[r + 1]); `first` has row_count + 1.

/// An item in its row.
TALUS_HD inline std::int64_t row_entry(int row, int item) {
  return (static_cast<std::int64_t>(row) << 32) | static_cast<std::int64_t>(item);
}

#if defined(TALUS_BACKEND_CUDA)

template <class RowOf>
struct WriteRowEntry {
  RowOf row_of;
  std::int64_t* entries;
  TALUS_HD void operator()(int i) const { entries[i] = row_entry(row_of(i), i); }
};
struct FindRow {
  const std::int64_t* entries;
  int count;
  int* first;
  TALUS_HD void operator()(int row) const { first[row] = lower_bound(entries, count, row_entry(row, 0)); }
};

template <class RowOf>
void sort_into_rows(int item_count, int row_count, const RowOf& row_of, DeviceVector<int>& first,
                    DeviceVector<std::int64_t>& entries) {
  entries.resize(static_cast<std::size_t>(item_count));
  first.resize(static_cast<std::size_t>(row_count) + 1);
  parallel_for(0, item_count, WriteRowEntry<RowOf>{row_of, pointer(entries)});
  sort(entries);
  parallel_for(0, row_count + 1, FindRow{pointer(entries), item_count, pointer(first)});
}

#else

/// By counting, on the calling thread.
template <class RowOf>
void sort_into_rows(int item_count, int row_count, const RowOf& row_of, DeviceVector<int>& first,
                    DeviceVector<std::int64_t>& entries) {
  entries.resize(static_cast<std::size_t>(item_count));
  first.assign(static_cast<std::size_t>(row_count) + 1, 0);
  int* const next = pointer(first) + 1;  // of each row; afterwards where the next row begins
  for (int i = 0; i < item_count; ++i)
    if (const int row = row_of(i); row + 1 < row_count) ++next[row + 1];
  for (int row = 1; row < row_count; ++row) next[row] += next[row - 1];
  for (int i = 0; i < item_count; ++i) {
    const int row = row_of(i);
    entries[static_cast<std::size_t>(next[row]++)] = row_entry(row, i);
  }
}

#endif

template <class T, int kValues>
struct CountBelow {
  const T* ascending;
  int entries;
  T values[kValues];
  int* counts;

  TALUS_HD void operator()(int i) const { counts[i] = lower_bound(ascending, entries, values[i]); }
};

/// Number of entries of an ascending column below each of the values.
template <class T, std::size_t kValues>
std::vector<int> counts_below(const DeviceVector<T>& ascending, const std::array<T, kValues>& values) {
  constexpr int count = static_cast<int>(kValues);
  DeviceVector<int> counts(kValues);
  CountBelow<T, count> kernel{pointer(ascending), static_cast<int>(ascending.size()), {}, pointer(counts)};
  std::copy(values.begin(), values.end(), kernel.values);
  parallel_for(0, count, kernel);
  return to_host(counts);
}

}  // namespace dem_gpu
