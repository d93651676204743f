// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bench_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "workflows/bench/case_file.h"

namespace {

using namespace workflows;

Figure figure(std::optional<double> value, std::optional<Goal> goal) {
  return {"error", value, "-", goal, value ? "" : "no rebound"};
}

TEST(BenchReport, AGoalIsMetUpToItsBound) {
  EXPECT_EQ(is_goal_met(figure(0.05, at_most(0.05))), true);
  EXPECT_EQ(is_goal_met(figure(0.051, at_most(0.05))), false);
  EXPECT_EQ(is_goal_met(figure(10, at_least(10))), true);
  EXPECT_EQ(is_goal_met(figure(9.9, at_least(10))), false);
  EXPECT_EQ(is_goal_met(figure(1e9, {})), std::nullopt);
}

TEST(BenchReport, AFailedRunMeetsNoGoal) {
  EXPECT_EQ(is_goal_met(figure({}, at_most(1))), false);
  EXPECT_EQ(is_goal_met(figure({}, {})), std::nullopt);
}

TEST(BenchReport, NotANumberMeetsNoGoal) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(is_goal_met(figure(nan, at_most(1))), false);
  EXPECT_EQ(is_goal_met(figure(nan, at_least(1))), false);
}

TEST(BenchReport, JsonHasOneObjectALineWithTheFieldsOfTheProductPage) {
  const std::string lines = json_lines({{"contact", "cube-face", figure(0.25, at_most(0.05)), "talus bench contact"},
                                        {"contact", "cube-face", figure({}, {}), "talus bench contact"}});
  const auto second = lines.find('\n') + 1;
  const auto measured = nlohmann::json::parse(lines.substr(0, second));
  EXPECT_EQ(measured, nlohmann::json::parse(R"({"bench": "contact", "case": "cube-face", "figure": "error",
      "value": 0.25, "unit": "-", "goal": "<= 0.05", "met": false, "command": "talus bench contact"})"));
  const auto failed = nlohmann::json::parse(lines.substr(second));
  EXPECT_TRUE(failed["value"].is_null());
  EXPECT_TRUE(failed["goal"].is_null());
  EXPECT_TRUE(failed["met"].is_null());
}

TEST(BenchReport, TablesShowTheFailureInPlaceOfTheValue) {
  const std::vector<ReportedFigure> figures{{"contact", "cube-face", figure({}, at_most(1)), "talus bench contact"}};
  EXPECT_NE(text_table(figures).find("failed: no rebound"), std::string::npos);
  EXPECT_NE(markdown_table("title", figures).find("| failed: no rebound |"), std::string::npos);
}

TEST(CaseFile, ComesBackAsWritten) {
  const test_support::TemporaryFolder folder;
  CaseResult result;
  result.figures = {{"path", 0.25, "-", at_most(0.5), ""},
                    {"speed", 2.5e7, "1/s", at_least(1), ""},
                    {"height", 0, "m", std::nullopt, ""}};
  result.curves = {{"front", "depth", {1, 2}, {0.1, kFailedRun}, {"a", "b"}, true}};
  write_case(folder / "case.json", "0.1: --seeds 3", result);
  const CaseResult read = read_case(folder / "case.json", "0.1: --seeds 3").value();
  ASSERT_EQ(read.figures.size(), 3u);
  EXPECT_EQ(goal_text(read.figures[0]), "<= 0.5");
  EXPECT_EQ(read.figures[1].value, 2.5e7);
  EXPECT_EQ(goal_text(read.figures[1]), ">= 1");
  EXPECT_EQ(read.figures[2].value, 0);
  EXPECT_FALSE(read.figures[2].goal);
  EXPECT_EQ(read.figures[2].unit, "m");
  ASSERT_EQ(read.curves.size(), 1u);
  EXPECT_EQ(read.curves[0].x, result.curves[0].x);
  EXPECT_EQ(read.curves[0].y[0], 0.1);
  EXPECT_TRUE(std::isnan(read.curves[0].y[1]));
  EXPECT_EQ(read.curves[0].point_names, result.curves[0].point_names);
  EXPECT_TRUE(read.curves[0].is_reference);
  EXPECT_FALSE(read_case(folder / "none.json", "0.1: --seeds 3"));
  EXPECT_FALSE(read_case(folder / "case.json", "0.1: --seeds 5")) << "measured with something else";
  result.figures[2] = {"height", std::nullopt, "m", std::nullopt, "step 3: a body flew off"};
  write_case(folder / "case.json", "0.1: --seeds 3", result);
  EXPECT_FALSE(read_case(folder / "case.json", "0.1: --seeds 3")) << "what failed is tried again";
}

}  // namespace
