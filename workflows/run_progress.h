// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace workflows {

/// Where a run stands, for its progress line.
struct RunStatus {
  double time = 0, end_time = 0;  // [s]
  std::int64_t step = 0, end_step = 0;
  double imbalance_share = 0;  // of the energy put in, at the last row of the series [-]; < 0 without a ledger
};

/// Progress of a run on stderr: a bar in place on a terminal, a line every few seconds elsewhere.
class RunProgress {
 public:
  explicit RunProgress(std::int64_t first_step);

  /// Shows the status if it is time to; the line, if one was shown that a log should keep, else "".
  std::string show(const RunStatus& status);
  /// Ends the bar.
  void finish() const;

  double seconds() const;                            // since the start
  double steps_per_second(std::int64_t step) const;  // since the start

 private:
  using Clock = std::chrono::steady_clock;
  bool is_terminal_;
  std::int64_t first_step_;
  Clock::time_point start_, last_shown_;
};

}  // namespace workflows
