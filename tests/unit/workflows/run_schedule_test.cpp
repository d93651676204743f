// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace workflows {
namespace {

TEST(RunSchedule, OutputsFallOnTheNearestStepWhereverTheRunStands) {
  const OutputTimes times{0.01, 3.3e-4};
  std::set<std::int64_t> due;
  for (std::int64_t k = 0; k < 200; ++k) due.insert(std::llround(double(k) * 0.01 / 3.3e-4));
  for (std::int64_t step = 0; step < 5000; ++step) {
    EXPECT_EQ(times.is_due(step), due.contains(step)) << step;
    EXPECT_EQ(times.next_step(step), *due.upper_bound(step)) << step;
  }
}

TEST(RunSchedule, AnIntervalOfOneStepIsEveryStep) {
  const OutputTimes times{1e-5, 1e-5};
  for (std::int64_t step = 0; step < 1000; ++step) EXPECT_TRUE(times.is_due(step));
}

TEST(RunSchedule, NoIntervalNoOutput) {
  const OutputTimes never{0, 1e-5};
  EXPECT_FALSE(never.is_due(0));
  EXPECT_GT(never.next_step(0), std::int64_t{1} << 60);
}

TEST(RunSchedule, TheLastSnapshotTakesTheNextNumber) {
  RunSchedule schedule;
  schedule.snapshots = {0.1, 0.01};
  schedule.end_step = 25;
  EXPECT_EQ(schedule.snapshot_number(0), 0);
  EXPECT_EQ(schedule.snapshot_number(20), 2);
  EXPECT_EQ(schedule.snapshot_number(25), 3);
  EXPECT_EQ(schedule.snapshot_number(30), 3);  // a longer run's own number 3
  EXPECT_EQ(schedule.steps_to_next(20), 5);
}

}  // namespace
}  // namespace workflows
