// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/decomposition/goal_rows.h"
#include "workflows/bench/decomposition/ladder_runs.h"

namespace workflows {

/// What the cases run so far have measured.
struct DecompositionResults {
  struct Row {
    GoalRow goal;
    int face_cap = 0;
    std::vector<LevelRun> runs;  // one a seed
  };
  std::vector<Row> rows;

  struct Time {
    std::string what;
    double cpu_seconds = 0, goal = 0;
  };
  std::vector<Time> times;

  struct Effort {
    std::string solid;
    int parts = 0, vertex_cap = 0;
    double effort = 0;
    double difference = 0;   // median over the seeds [-]
    double cpu_seconds = 0;  // the same
  };
  std::vector<Effort> efforts;

  struct Front {
    std::string solid;
    LevelRun run;
    double cost = 0;  // measured, of a contact over that of cubes [-]
  };
  std::vector<Front> front;  // every level of the ladders, in the order made

  std::vector<std::string> left_out;  // solids without a file
  int seeds = 0;
};

/// Tables of everything measured, in Markdown that reads on a terminal too.
std::string decomposition_page(const DecompositionResults& results);

}  // namespace workflows
