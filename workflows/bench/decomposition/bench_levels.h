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
inline const std::string kTimeCase = "time-" + kTimedSolid, kEffortCase = "effort-" + kTimedSolid;

struct TimeGoal {
  std::string name;
  std::vector<int> parts;
  double seconds;  // CPU time at most
};
inline const std::vector<TimeGoal> kTimeGoals{
    {"8 parts x 64 vertices, CPU time, median", {8}, 5},
    {"1, 2, 4, 8, 16, 32 parts x 64 vertices, CPU time, median", kLadder, 25}};

inline constexpr int kEffortParts[] = {2, 8, 16}, kEffortVertexCap = 64;
inline constexpr double kEfforts[] = {0.25, 1, 4};

/// "8 x 64, 25 % of the usual effort: CPU time"
inline std::string effort_figure(int parts, double effort, const std::string& what) {
  return std::to_string(parts) + " x " + std::to_string(kEffortVertexCap) + ", " +
         std::to_string(static_cast<int>(100 * effort)) + " % of the usual effort: " + what;
}

/// Ladders whose levels are held against what they cost: one solid under every cap, the others under the usual one
/// (seven curves of a plot can be told apart).
struct FrontCase {
  std::string solid;
  std::vector<catalog::LevelKey> ladders;  // caps

  std::string name() const { return "front-" + solid; }
};
inline const std::vector<FrontCase> kFrontCases{{kTimedSolid, {{0, 16}, {0, 32}, {0, 64}, {0, 64, 24}, {0, 64, 34}}},
                                                {"ashlar_1050", {{0, 64}}},
                                                {"itokawa", {{0, 64}}},
                                                {"torus", {{0, 64}}}};

/// "64-f24, 8 parts: faces"
inline std::string front_figure(const catalog::LevelKey& key, const std::string& what) {
  return ladder_name(key) + ", " + std::to_string(key.parts_asked) + " parts: " + what;
}

}  // namespace workflows
