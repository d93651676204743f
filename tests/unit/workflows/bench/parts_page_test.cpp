// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/parts/parts_page.h"

#include <gtest/gtest.h>

namespace workflows {
namespace {

using Figures = std::vector<ReportedFigure>;

void add(Figures& figures, const std::string& case_name, const std::string& name, double value) {
  figures.push_back({"parts", case_name, {name, value, "", {}, ""}, ""});
}

void add_level(Figures& figures, const std::string& case_name, double error, double packing, double step_time) {
  add(figures, case_name, kLevelError, error);
  const double answers[] = {packing, 50, 0.2, 0.3};
  for (std::size_t i = 0; i < std::size(kBedAnswers); ++i) add(figures, case_name, kBedAnswers[i], answers[i]);
  add(figures, case_name, kStepTime, step_time);
}

void add_spread(Figures& figures) {
  const double deviations[] = {0.002, 1, 0.01, 0.02};
  for (std::size_t i = 0; i < std::size(kBedAnswers); ++i) {
    add(figures, "rock-spread", mean_of(kBedAnswers[i]), 1);
    add(figures, "rock-spread", deviation_of(kBedAnswers[i]), deviations[i]);
  }
}

PartsStudy study() {
  return {"rock", {{"rock-16-1", "1 x 16"}, {"rock-16-4", "4 x 16"}, {"rock-16-32", "32 x 16"}}, "rock-spread"};
}

/// Four parts are two standard deviations off the finest in packing, one part five.
Figures three_levels() {
  Figures figures;
  add_level(figures, "rock-16-1", 0.10, 0.560, 5);
  add_level(figures, "rock-16-4", 0.07, 0.554, 10);
  add_level(figures, "rock-16-32", 0.03, 0.550, 40);
  return figures;
}

TEST(PartsPage, NamesTheCheapestLevelThatChanceHidesFromTheFinest) {
  Figures figures = three_levels();
  add_spread(figures);
  const std::string page = parts_page(figures, {study()});
  EXPECT_NE(page.find("from the finest (32 x 16), nor any level of less error, is **4 x 16**, error 7.0 %: a step of "
                      "it takes 0.25 of the time"),
            std::string::npos)
      << page;
}

TEST(PartsPage, ALevelThatAgreesByChanceWhereBetterOnesDoNotIsNotNamed) {
  Figures figures;
  add_level(figures, "rock-16-1", 0.10, 0.551, 5);  // half a standard deviation off
  add_level(figures, "rock-16-4", 0.07, 0.560, 10);
  add_level(figures, "rock-16-32", 0.03, 0.550, 40);
  add_spread(figures);
  const std::string page = parts_page(figures, {study()});
  EXPECT_EQ(page.find("**1 x 16**"), std::string::npos) << page;
  EXPECT_NE(page.find("Every cheaper level can be told from the finest one (32 x 16)"), std::string::npos) << page;
}

TEST(PartsPage, SaysWhereEveryLevelDiffers) {
  Figures figures;
  add_level(figures, "rock-16-1", 0.10, 0.60, 5);
  add_level(figures, "rock-16-32", 0.03, 0.55, 40);
  add_spread(figures);
  EXPECT_NE(parts_page(figures, {study()}).find("Every cheaper level can be told from the finest one (32 x 16)"),
            std::string::npos);
}

TEST(PartsPage, AnAnswerThatNeverChangesTellsNoLevelsApart) {
  Figures figures = three_levels();
  const double deviations[] = {0.002, 1, 0.01, 0};
  for (std::size_t i = 0; i < std::size(kBedAnswers); ++i)
    add(figures, "rock-spread", deviation_of(kBedAnswers[i]), deviations[i]);
  EXPECT_NE(parts_page(figures, {study()}).find("is **4 x 16**"), std::string::npos);
}

TEST(PartsPage, ConcludesNothingWithoutTheSpread) {
  EXPECT_NE(parts_page(three_levels(), {study()}).find("nothing can be said yet"), std::string::npos);
}

TEST(PartsPage, LeavesOutWhatWasNotRun) {
  Figures figures = three_levels();
  figures.resize(figures.size() / 3);
  const std::string page = parts_page(figures, {study()});
  EXPECT_NE(page.find("| 1 x 16"), std::string::npos);
  EXPECT_EQ(page.find("| 4 x 16"), std::string::npos);
}

TEST(PartsPage, HasNoSectionForAShapeWithoutFigures) {
  EXPECT_EQ(parts_page({}, {study()}).find("## rock"), std::string::npos);
}

}  // namespace
}  // namespace workflows
