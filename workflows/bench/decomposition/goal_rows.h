// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "catalog/fit_mode.h"
#include "workflows/bench/bench_plan.h"
#include "workflows/bench/decomposition/ladder_runs.h"

namespace workflows {

/// A level with goals for its symmetric difference, the median over the seeds.
struct GoalRow {
  std::string solid;
  int parts = 1, vertex_cap = 64;
  catalog::FitMode mode = catalog::FitMode::volume_true;
  double goal = 0, stretch = 0;  // [%]
  std::string best_public;       // what the best public tools reach on the same file; empty: not known
};

const std::vector<GoalRow>& goal_rows();

/// Caps of faces that the rows are measured under; the goals hold for the first, 0, which is none.
inline constexpr int kFaceCaps[] = {0, 24, 34};

/// The figures of a row from the runs of its seeds; goals only where there is no cap of faces.
std::vector<Figure> row_figures(const GoalRow& row, const std::vector<LevelRun>& runs);

/// "8 x 64", "8 x 64, enclosing".
std::string row_text(const GoalRow& row);

}  // namespace workflows
