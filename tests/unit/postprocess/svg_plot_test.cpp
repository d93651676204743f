// SPDX-License-Identifier: Apache-2.0
#include "postprocess/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/postprocess/well_formed.h"

namespace postprocess {
namespace {

using test_support::xml_fault;

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(WellFormed, SeesFaults) {
  EXPECT_EQ(xml_fault("<a b=\"1 > 0\"><c/>x &amp; y</a>"), "");
  EXPECT_NE(xml_fault("<a><b></a></b>"), "");
  EXPECT_NE(xml_fault("<a>x & y</a>"), "");
  EXPECT_NE(xml_fault("<a>"), "");
}

TEST(AxisTicks, AreRoundAndInside) {
  EXPECT_EQ(axis_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(axis_ticks(-1.2, 1.1, 4), (std::vector<double>{-1, 0, 1}));
  for (const double scale : {1e-7, 3e-3, 42.0, 8e9}) {
    const std::vector<double> ticks = axis_ticks(-0.3 * scale, scale, 6);
    EXPECT_GE(ticks.size(), 3u) << scale;
    EXPECT_LE(ticks.size(), 8u) << scale;
    EXPECT_GE(ticks.front(), -0.3 * scale * (1 + 1e-6));
    EXPECT_LE(ticks.back(), scale * (1 + 1e-6));
  }
  EXPECT_TRUE(axis_ticks(1, 1, 5).empty());
}

TEST(ShortNumber, DropsWhatSaysNothing) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.05), "0.05");
  EXPECT_EQ(short_number(48200), "48200");
  EXPECT_EQ(short_number(1.23456), "1.235");
  EXPECT_EQ(short_number(-0.0012345, 3), "-0.00123");
  EXPECT_EQ(short_number(1.2e-6), "1.2e-06");
  EXPECT_EQ(short_number(std::nan("")), "not a number");
}

TEST(LinePlotSvg, IsWellFormedAndNamesItsAxes) {
  const LinePlot plot{"Power <of> \"a\" & b",
                      "time [s]",
                      "power [W]",
                      {{"torque & ledger", {0, 1, 2}, {1, 4, 2}}, {"", {0, 2}, {3, 3}, true}},
                      {}};
  const std::string text = svg(plot);
  EXPECT_EQ(xml_fault(text), "");
  EXPECT_NE(text.find(">time [s]<"), std::string::npos);
  EXPECT_NE(text.find(">power [W]<"), std::string::npos);
  EXPECT_NE(text.find(">torque &amp; ledger<"), std::string::npos);
  EXPECT_EQ(count_of(text, "<polyline"), 2u);
  EXPECT_EQ(svg(plot), text);
}

TEST(LinePlotSvg, BreaksTheLineWhereThereIsNoValue) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string text = svg(LinePlot{"", "x", "y", {{"", {0, 1, 2, 3, 4}, {1, 2, none, 2, 1}}}, {}});
  EXPECT_EQ(count_of(text, "<polyline"), 2u);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(LinePlotSvg, DrawsNothingAndAFlatLineWithoutFault) {
  for (const LinePlot& plot :
       {LinePlot{"", "x", "y", {}, {}}, LinePlot{"", "x", "y", {{"", {}, {}}}, {}},
        LinePlot{"", "x", "y", {{"", {1, 1}, {0, 0}}}, {}}, LinePlot{"", "x", "y", {{"", {0, 1}, {5e-9, 5e-9}}}, {}}}) {
    const std::string text = svg(plot);
    EXPECT_EQ(xml_fault(text), "");
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
  }
}

TEST(LinePlotSvg, AMillionPointsStaySmallAndKeepThePeak) {
  Curve curve{"", {}, {}};
  for (int i = 0; i < 1'000'000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 654'321 ? 10 : std::sin(i));
  }
  LinePlot plot{"", "x", "y", {curve}, std::pair{-1.0, 10.0}};
  const std::string text = svg(plot);
  EXPECT_LT(text.size(), 100'000u);
  // The peak is on the plot's upper edge, 34 px from the top.
  EXPECT_NE(text.find(",34.0 "), std::string::npos);
}

TEST(BarPlotSvg, BarsAreAsLongAsTheirValues) {
  BarPlot plot{"Loss", "energy [J]", "normal", "shear", {{"a", 30, 10}, {"b", 20, 0}}};
  const std::string text = svg(plot);
  EXPECT_EQ(xml_fault(text), "");
  EXPECT_EQ(count_of(text, "<rect"), 1u + 2 + 4);  // page, legend, two for each bar
  EXPECT_EQ(xml_fault(svg(BarPlot{"", "", "", "", {}})), "");
}

}  // namespace
}  // namespace postprocess
