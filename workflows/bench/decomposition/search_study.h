// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "workflows/bench/bench_plan.h"
#include "workflows/bench/decomposition/bench_levels.h"
#include "workflows/bench/decomposition/ladder_runs.h"

namespace workflows {

/// How often, and by how much at most, a search found a worse level than one of less time with the same seed.
struct Setback {
  int seeds = 0;
  double largest = 0;  // of the symmetric difference [% of the volume]
};

/// Of runs in the order of their time, each with one entry a seed. What the measurement's own errors explain (three
/// standard errors of the two runs together) does not count.
Setback setback(const std::vector<std::vector<LevelRun>>& before, const std::vector<LevelRun>& now);

/// `run` makes the level of so many parts with a seed, counted from 1, and a setting.
CaseResult measure_search_study(const SearchStudy& study, int seeds,
                                const std::function<LevelRun(int parts, int seed, double setting)>& run);

}  // namespace workflows
