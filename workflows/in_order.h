// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace workflows {

/// A batch of pieces of work on several threads whose results are taken in the order of the pieces, so that what is
/// stored does not depend on the number of threads.
template <class Result>
struct OrderedWork {
  int count = 0;
  int threads = 1;
  std::function<void(int)> begin;           // before a piece, in order, one at a time with `take`
  std::function<Result(int)> make;          // side by side
  std::function<void(int, Result&&)> take;  // in order, one at a time
};

/// At most `threads` results wait besides those in work. The first exception ends the batch once the pieces in work are
/// done, and is rethrown here.
template <class Result>
class InOrder {
 public:
  explicit InOrder(const OrderedWork<Result>& work) : work_(work) {}

  void run() {
    std::vector<std::thread> pool;
    for (int t = 1; t < std::min(work_.threads, work_.count); ++t) pool.emplace_back([this] { keep_working(); });
    keep_working();
    for (std::thread& thread : pool) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void keep_working() {
    std::unique_lock lock(mutex_);
    try {
      while (true) {
        room_.wait(lock, [&] { return failure_ || next_ == work_.count || next_ < taken_ + 2 * work_.threads; });
        if (failure_ || next_ == work_.count) return;
        const int piece = next_++;
        work_.begin(piece);
        lock.unlock();
        Result result = work_.make(piece);
        lock.lock();
        waiting_.emplace(piece, std::move(result));
        take_what_is_ready();
      }
    } catch (const std::exception&) {
      if (!lock.owns_lock()) lock.lock();
      if (!failure_) failure_ = std::current_exception();
      room_.notify_all();
    }
  }

  void take_what_is_ready() {
    for (auto ready = waiting_.find(taken_); ready != waiting_.end(); ready = waiting_.find(taken_)) {
      work_.take(taken_, std::move(ready->second));
      waiting_.erase(ready);
      ++taken_;
    }
    room_.notify_all();
  }

  const OrderedWork<Result>& work_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::map<int, Result> waiting_;
  int next_ = 0, taken_ = 0;
  std::exception_ptr failure_;
};

template <class Result>
void run_in_order(const OrderedWork<Result>& work) {
  InOrder<Result>(work).run();
}

/// `threads`, or as many as the machine has where that is 0.
inline int threads_to_use(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace workflows
