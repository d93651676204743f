// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(TALUS_BACKEND_TBB)
#include <tbb/global_control.h>
#elif defined(TALUS_BACKEND_OMP)
#include <omp.h>
#endif

#include <cstddef>

namespace test_support {

/// Keeps the engine to so many threads while it lives; where the back end has no threads, nothing.
class ThreadLimit {
 public:
#if defined(TALUS_BACKEND_TBB)
  explicit ThreadLimit(int threads)
      : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}

 private:
  tbb::global_control limit_;
#elif defined(TALUS_BACKEND_OMP)
  explicit ThreadLimit(int threads) : before_(omp_get_max_threads()) { omp_set_num_threads(threads); }
  ~ThreadLimit() { omp_set_num_threads(before_); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
#else
  explicit ThreadLimit(int) {}
  ~ThreadLimit() {}
#endif
};

}  // namespace test_support
