// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/goal_rows.h"

#include <cmath>

namespace workflows {
namespace {

// Goals for every level [%].
constexpr double kVolumeError = 0.1;
constexpr double kShortestEdge = 1, kNarrowestFace = 2;  // of the part's size
// Rounding of the rays' lengths [%], where nothing is missing.
constexpr double kNothing = 1e-9;

}  // namespace

const std::vector<GoalRow>& goal_rows() {
  using catalog::FitMode;
  // V-HACD 4.1 and CoACD, scored by the same definitions on the same files.
  static const std::vector<GoalRow> rows{
      {"stone14", 8, 64, FitMode::volume_true, 4.2, 3.8, "9.3 % in 31 CPU s"},
      {"stone14", 8, 32, FitMode::volume_true, 4.4, 4.0, ""},
      {"stone14", 1, 64, FitMode::volume_true, 9.2, 9.0, "17.2 %, 836 vertices"},
      {"stone14", 16, 64, FitMode::volume_true, 3.0, 2.7, "7.9 %, 15 parts"},
      {"stone10", 8, 64, FitMode::volume_true, 3.5, 3.2, ""},
      {"ashlar_1050", 2, 64, FitMode::volume_true, 2.15, 2.05, "4.9 %"},
      {"ashlar_1050", 8, 64, FitMode::volume_true, 1.4, 1.25, ""},
      {"itokawa", 1, 64, FitMode::volume_true, 2.0, 1.8, "7.8 %"},
      {"torus", 8, 64, FitMode::volume_true, 6.2, 5.0, "13.1 %"},
      {"stone14", 8, 64, FitMode::enclosing, 10.0, 8.0, "14 % and more"},
  };
  return rows;
}

std::vector<Figure> row_figures(const GoalRow& row, const std::vector<LevelRun>& runs) {
  const std::string level = std::to_string(row.parts) + " parts: ";
  std::vector<Figure> figures;
  const bool has_goals = runs.front().level.key.face_cap == 0;
  const auto add = [&](const std::string& name, double value, const char* unit, std::optional<Goal> goal = {}) {
    if (!has_goals) goal.reset();
    figures.push_back({level + name, value, unit, goal, ""});
  };
  const auto difference = [](const LevelRun& run) { return 100 * run.level.error.symmetric_difference; };
  add("symmetric difference, median", median(runs, difference), "%", at_most(row.goal));
  add("symmetric difference, best", least(runs, difference), "%");
  add("symmetric difference, worst", most(runs, difference), "%");
  add("symmetric difference, stretch goal", row.stretch, "%");
  add("standard error of it, worst", most(runs, [](const LevelRun& run) { return 100 * run.level.error.method_error; }),
      "%");
  const auto missing = [](const LevelRun& run) { return 100 * run.level.error.missing_volume; };
  if (row.mode == catalog::FitMode::enclosing)
    add("missing volume, worst", most(runs, missing), "%", at_most(kNothing));
  else
    add("volume error, worst",
        most(runs, [](const LevelRun& run) { return 100 * std::abs(run.level.error.volume_error); }), "%",
        at_most(kVolumeError));
  add("pairs of parts that overlap", most(runs, [](const LevelRun& run) { return run.overlapping_pairs; }), "-",
      at_most(0));
  add("shortest edge, worst", least(runs, [](const LevelRun& run) { return 100 * run.figures.shortest_edge; }),
      "% of part", at_least(kShortestEdge));
  add("narrowest face, worst", least(runs, [](const LevelRun& run) { return 100 * run.figures.narrowest_face; }),
      "% of part", at_least(kNarrowestFace));
  add("ledges, worst", most(runs, [](const LevelRun& run) { return 100 * run.figures.ledge_area; }), "% of cuts");
  add("CPU time of the ladder, median", median(runs, [](const LevelRun& run) { return run.cpu_seconds; }), "s");
  return figures;
}

std::string row_text(const GoalRow& row) {
  const std::string text = std::to_string(row.parts) + " x " + std::to_string(row.vertex_cap);
  return row.mode == catalog::FitMode::volume_true ? text : text + ", " + mode_name(row.mode);
}

}  // namespace workflows
