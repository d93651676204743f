// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/log_plot.h"

#include <gtest/gtest.h>

#include <regex>
#include <utility>

namespace {

using namespace workflows;

const PlotAxes kAxes{"error", "Cost & error", "time [s]", "error <-->"};

std::vector<std::pair<double, double>> circles(const std::string& svg) {
  const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::vector<std::pair<double, double>> places;
  for (std::sregex_iterator i(svg.begin(), svg.end(), circle), end; i != end; ++i)
    places.emplace_back(std::stod((*i)[1]), std::stod((*i)[2]));
  return places;
}

TEST(LogPlot, EqualRatiosAreEqualDistances) {
  const auto places =
      circles(log_plot_svg(kAxes, {{"error", "curve", {1e-3, 1e-2, 1e-1}, {1e-1, 1e-3, 1e-5}, {"5", "10", "20"}}}));
  ASSERT_EQ(places.size(), 3u);
  constexpr double kRounding = 0.2;  // of the coordinates as printed [px]
  EXPECT_NEAR(places[1].first - places[0].first, places[2].first - places[1].first, kRounding);
  EXPECT_NEAR(places[1].second - places[0].second, places[2].second - places[1].second, kRounding);
  EXPECT_GT(places[2].first, places[0].first);
  EXPECT_GT(places[2].second, places[0].second) << "a smaller error stands lower";
}

TEST(LogPlot, FewPowersOfTenAreDividedAtTwoAndFive) {
  const auto ticks_of = [](double y) {
    return log_plot_svg(kAxes, {{"error", "curve", {1, 10}, {1, y}, {"5", "10"}}});
  };
  EXPECT_NE(ticks_of(0.02).find(">0.05</text>"), std::string::npos);
  EXPECT_EQ(ticks_of(1e-6).find(">0.05</text>"), std::string::npos);
  EXPECT_NE(ticks_of(1e-6).find(">1e-6</text>"), std::string::npos);
}

TEST(LogPlot, FailedRunsAreNamedAndNotDrawn) {
  const std::string svg =
      log_plot_svg(kAxes, {{"error", "cube", {1e-3, kFailedRun}, {1e-1, kFailedRun}, {"5 steps", "10 steps"}}});
  EXPECT_EQ(circles(svg).size(), 1u);
  EXPECT_NE(svg.find("failed: cube, 10 steps"), std::string::npos);
  EXPECT_EQ(svg.find("failed: cube, 5 steps"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(LogPlot, AnErrorOfZeroAndAnotherPlotsCurveAreLeftOut) {
  const std::string svg =
      log_plot_svg(kAxes, {{"error", "exact", {1e-3}, {0}, {"5"}}, {"other", "elsewhere", {1e-3}, {1e-3}, {"5"}}});
  EXPECT_TRUE(circles(svg).empty());
  EXPECT_EQ(svg.find("elsewhere"), std::string::npos);
  EXPECT_EQ(svg.find("failed:"), std::string::npos);
}

TEST(LogPlot, TextIsEscaped) {
  const std::string svg = log_plot_svg(kAxes, {});
  EXPECT_NE(svg.find("Cost &amp; error"), std::string::npos);
  EXPECT_NE(svg.find("error &lt;--&gt;"), std::string::npos);
}

}  // namespace
