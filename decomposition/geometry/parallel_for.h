// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace decomposition {

/// Calls task(i) for i in [0, count) on up to `threads` threads. Tasks write only to their own slot, so the result does
/// not depend on the number of threads. The first exception is rethrown here.
template <class Task>
void parallel_for(int count, int threads, const Task& task) {
  if (threads > count) threads = count;
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  std::atomic<int> next{0};
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(threads));
  const auto work = [&](int thread) {
    try {
      for (int i = next++; i < count; i = next++) task(i);
    } catch (const std::exception&) {
      failures[static_cast<std::size_t>(thread)] = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  for (int thread = 1; thread < threads; ++thread) pool.emplace_back(work, thread);
  work(0);
  for (std::thread& thread : pool) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace decomposition
