// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is measured beside the rows of goals, and the names that its figures have in the results.

#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "workflows/bench/level_cost.h"

namespace workflows {

/// Numbers of parts of a whole ladder.
inline const std::vector<int> kLadder{1, 2, 4, 8, 16, 32};

/// The scan of 30,000 faces that times are measured with.
inline const std::string kTimedSolid = "stone14";
inline const std::string kTimeCase = "time-" + kTimedSolid, kEffortCase = "effort-" + kTimedSolid,
                         kBudgetCase = "budget-" + kTimedSolid;

/// A figure of every case: what measuring it took, on all threads [s].
inline const std::string kCaseTime = "CPU time of the case";

struct TimeGoal {
  std::string name;
  std::vector<int> parts;
  double seconds;  // CPU time at most
};
inline const std::vector<TimeGoal> kTimeGoals{
    {"8 parts x 64 vertices, CPU time, median", {8}, 5},
    {"1, 2, 4, 8, 16, 32 parts x 64 vertices, CPU time, median", kLadder, 25}};

/// Searches of more and more time; each is held against the best of those with less, seed by seed.
struct SearchStudy {
  std::string name;  // of the option: "effort"
  std::string unit;  // of its settings: "", " s"
  std::vector<double> settings;
  std::vector<int> parts;
  bool is_anytime = false;  // more time must not make a level worse
  int vertex_cap = 64;

  /// "8 x 64"
  std::string level(int of_parts) const { return std::to_string(of_parts) + " x " + std::to_string(vertex_cap); }
  /// "8 x 64, effort 0.25: CPU time"
  std::string figure(int of_parts, double setting, const std::string& what) const;
};
inline const SearchStudy kEffortStudy{"effort", "", {0.25, 1, 4}, {2, 8, 16}},
    kBudgetStudy{"time budget", " s", {1, 2, 4, 8, 16}, {8}, true};

/// Ladders whose levels are held against what they cost: one solid under every cap, the others under the usual one.
struct FrontCase {
  std::string solid;
  std::vector<catalog::LevelKey> ladders;  // caps

  std::string name() const { return "front-" + solid; }
};
inline constexpr catalog::LevelKey kFrontCaps{0, 64};
inline const std::vector<FrontCase> kFrontCases{{kTimedSolid, {{0, 16}, {0, 32}, kFrontCaps, {0, 64, 24}, {0, 64, 34}}},
                                                {"ashlar_1050", {kFrontCaps}},
                                                {"itokawa", {kFrontCaps}},
                                                {"torus", {kFrontCaps}}};

/// "64-f24, 8 parts: faces"
inline std::string front_figure(const catalog::LevelKey& key, const std::string& what) {
  return ladder_name(key) + ", " + std::to_string(key.parts_asked) + " parts: " + what;
}

}  // namespace workflows
