// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/benchmark/scenes/speed_scenes.h"

namespace benchmark_counts {

/// A settled scene of which some steps are counted.
struct CountedRun {
  std::string name;
  std::string scene;
  benchmark_scenes::Law law;
  int bodies;
  int steps;
};

/// Small ones for the guard: a few seconds each under callgrind.
const std::vector<CountedRun>& guard_runs();
/// The scenes at their own size.
const std::vector<CountedRun>& whole_runs();
/// Throws catalog::UsageError for an unknown name.
const CountedRun& counted_run(const std::string& name);

/// Steps before those that are counted: friction forms again, the neighbour list is made.
inline constexpr int kWarmUpSteps = 100;

/// Lets the scene of the run settle, without callgrind, and leaves it in `folder`; runs of one scene and size share it.
void settle_into(const std::filesystem::path& folder, const CountedRun& run);

/// Under callgrind with --instr-atstart=no: goes on from `folder`, only the steps of the run being counted.
void step_counted(const std::filesystem::path& folder, const CountedRun& run);

}  // namespace benchmark_counts
