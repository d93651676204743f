// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_plan.h"

namespace workflows {

/// Names of the figures of a case, and of those of the spread.
inline constexpr const char* kLevelError = "symmetric difference [-]";
inline constexpr const char* kStepTime = "time a step [ms]";
inline constexpr const char* kBedAnswers[] = {"packing fraction [-]", "slide angle [degrees]", "half emptied after [s]",
                                              "share left on the shelf [-]"};
std::string mean_of(const std::string& answer);
std::string deviation_of(const std::string& answer);

/// The levels of one shape.
struct PartsStudy {
  struct Row {
    std::string case_name;
    std::string level;  // "8 x 32"
  };
  std::string shape;
  std::vector<Row> rows;
  std::string spread_case;
};

/// What the bed answers and costs at every level, how far that is from the finest level's, over chance, and the
/// cheapest level that cannot be told from the finest.
std::string parts_page(const std::vector<ReportedFigure>& figures, const std::vector<PartsStudy>& studies);

}  // namespace workflows
