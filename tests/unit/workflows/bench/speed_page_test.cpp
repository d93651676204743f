// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "workflows/bench/speed/speed_cases.h"

namespace {

using namespace workflows;

std::vector<ReportedFigure> figures_of(const std::string& case_name, double time) {
  const auto reported = [&](const std::string& name, double value, std::optional<Goal> goal = {}) {
    return ReportedFigure{"speed", case_name, {name, value, "-", goal, ""}, "talus bench speed --case " + case_name};
  };
  return {reported(kStepTime, time, at_most(2)), reported(kStepTimeLeast, 0.9 * time),
          reported(kStepTimeLargest, 1.1 * time), reported(kCoordination, 5.25)};
}

TEST(SpeedPage, HasARowACaseWithItsSpreadAndGoal) {
  std::vector<ReportedFigure> figures = figures_of("s1-box", 1.5);
  for (const ReportedFigure& figure : figures_of("s2-depth", 3)) figures.push_back(figure);
  const std::string page = speed_page(figures);
  EXPECT_NE(page.find("| s1-box | 1.500 (1.350 to 1.650) | <= 2 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| s2-depth | 3.000 (2.700 to 3.300) | <= 2 |"), std::string::npos) << page;
}

TEST(SpeedPage, LeavesOutWhatWasNotMeasured) {
  EXPECT_NE(speed_page(figures_of("s1-box", 1.5)).find("| - | - | 5.25 | - | - |"), std::string::npos);
  EXPECT_EQ(speed_page({}).find("ms a step"), std::string::npos);
}

}  // namespace
