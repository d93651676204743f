// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
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

  /// "8 x 64", "8 x 64, enclosing"
  std::string text() const;
  /// "stone14-64-f24": rows of one solid, cap of vertices and mode share a case under each cap of faces.
  std::string case_name(int face_cap) const;
};

const std::vector<GoalRow>& goal_rows();

/// Caps of faces that the rows are measured under; the goals of the difference hold for the first, 0, which is none.
inline constexpr int kFaceCaps[] = {0, 24, 34};

/// A figure of a row, over its seeds, and how the page shows it.
struct RowFigure {
  std::string name, unit;
  std::string heading;  // of its column
  int decimals = 0;
  decltype(&median) over_seeds = nullptr;
  double (*of)(const LevelRun&) = nullptr;
  std::function<std::optional<Goal>(const GoalRow&)> goal{};  // empty: none

  /// "8 parts: shortest edge, least"
  std::string name_in(const GoalRow& row) const { return std::to_string(row.parts) + " parts: " + name; }
};

// The columns of the page's tables; the first of all is the one that the goals are for.
const std::vector<RowFigure>& difference_figures();
const std::vector<RowFigure>& error_figures();
const std::vector<RowFigure>& rule_figures();

/// All of them from the runs of a row's seeds. Under a cap of faces the rules have goals, the difference has none.
std::vector<Figure> row_figures(const GoalRow& row, const std::vector<LevelRun>& runs);

}  // namespace workflows
