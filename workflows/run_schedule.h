// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace workflows {

/// An output every `interval` of simulated time, at the nearest whole steps: step numbers follow from interval and time
/// step alone, so that a resumed run writes the same files.
struct OutputTimes {
  double interval = 0;   // [s]; 0: never
  double time_step = 0;  // [s], at most `interval`

  std::int64_t step_of(std::int64_t index) const { return std::llround(double(index) * interval / time_step); }

  /// Index of the last output at or before `step`; -1 if there is none.
  std::int64_t last_index(std::int64_t step) const {
    if (!(interval > 0)) return -1;
    auto index = static_cast<std::int64_t>(double(step) * time_step / interval) + 1;
    while (step_of(index) > step) --index;
    return index;
  }

  bool is_due(std::int64_t step) const {
    const std::int64_t index = last_index(step);
    return index >= 0 && step_of(index) == step;
  }

  std::int64_t next_step(std::int64_t step) const {
    return interval > 0 ? step_of(last_index(step) + 1) : std::numeric_limits<std::int64_t>::max();
  }
};

/// When a run ends and writes what.
struct RunSchedule {
  OutputTimes snapshots, series, checkpoints;
  std::int64_t end_step = 0;

  /// Steps until something is due, from `step` on.
  std::int64_t steps_to_next(std::int64_t step) const {
    return std::min({snapshots.next_step(step), series.next_step(step), checkpoints.next_step(step), end_step}) - step;
  }

  /// Number of the snapshot file due at `step`. The one at the end may lie off the grid; a longer run writes over it.
  std::int64_t snapshot_number(std::int64_t step) const {
    return snapshots.last_index(step) + (snapshots.is_due(step) ? 0 : 1);
  }
};

}  // namespace workflows
