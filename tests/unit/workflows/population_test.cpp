// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "catalog/input_error.h"
#include "tests/support/temporary_folder.h"
#include "workflows/catalog_listing.h"
#include "workflows/population/comparison_report.h"
#include "workflows/population/stratified_rows.h"
#include "workflows/shape_sampling.h"

namespace {

using namespace workflows;
using test_support::TemporaryFolder;
using test_support::write_bytes;

const std::string kSandAtlas =
    "Particle ID,Equivalent Diameter (\u00b5m),Major Axis Length (\u00b5m),Middle Axis Length (\u00b5m),"
    "Minor Axis Length (\u00b5m),True Sphericity (-),Convexity (-),Flatness (-),Elongation (-)\n";
const std::string kGrain = "7,250,400,200,100,0.8,0.9,0.5,0.5\n";

std::string grains(int count) {
  std::string text;
  for (int k = 0; k < count; ++k) text += kGrain;
  return text;
}

/// What reading the file's text is refused with; empty if it is not.
std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  write_bytes(folder / "sand.csv", text);
  try {
    read_form_table(folder / "sand.csv", "");
    return "";
  } catch (const catalog::InputError& error) {
    return error.what();
  }
}

TEST(FormTable, ReadsTheSandAtlasWithFlatnessAsSOverI) {
  const TemporaryFolder folder;
  write_bytes(folder / "sand.csv", "\ufeff" + kSandAtlas + "7,250,400,300,100,0.8,0.9,0.333333,0.75\r\n" + grains(9));
  const FormTable table = read_form_table(folder / "sand.csv", "");
  EXPECT_EQ(table.source, "sand.csv");
  EXPECT_EQ(table.sha256.size(), 64u);
  EXPECT_NE(table.axes.find("ellipsoid of equal second moments"), std::string::npos);
  ASSERT_EQ(table.rows.size(), 10u);
  const FormRow expected{250e-6, 0.333333, 0.75, 0.9, 0.8};
  for (std::size_t c = 0; c < kFormFigures; ++c) EXPECT_NEAR(table.rows[0][c], expected[c], 1e-15) << kFormNames[c];
}

TEST(FormTable, ReadsItsOwnNamesInMetresOrTheUnitBesideThem) {
  for (const auto& [heading, diameter] :
       {std::pair("equivalent_diameter_volume", "0.002"), std::pair("equivalent_diameter_volume [mm]", "2")}) {
    std::string text =
        std::string("sphericity_wadell,") + heading + ",convexity_volume_ratio [%],i_over_l_inertia,s_over_i_inertia\n";
    for (int k = 0; k < 10; ++k) text += std::string("0.8,") + diameter + ",90,0.7,0.6\n";
    const TemporaryFolder folder;
    write_bytes(folder / "own.csv", text);
    const FormRow row = read_form_table(folder / "own.csv", "").rows[0], expected{2e-3, 0.6, 0.7, 0.9, 0.8};
    for (std::size_t c = 0; c < kFormFigures; ++c) EXPECT_NEAR(row[c], expected[c], 1e-15) << kFormNames[c];
  }
}

TEST(FormTable, RefusesByFileLineAndColumn) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = kSandAtlas + grains(10);
  ASSERT_EQ(refusal(good), "");
  const std::pair<std::string, std::string> cases[] = {
      {"", "is empty"},
      {kSandAtlas, "has 0 grains, expected 10"},
      {kSandAtlas + kGrain, "has 1 grains, expected 10"},
      {replaced(good, "Convexity (-)", "Solidity (-)"), "no column for convexity_volume_ratio (or 'Convexity (-)')"},
      {replaced(good, "Flatness", "flat"), "no column for s_over_i_inertia"},
      {replaced(good, "Diameter (\u00b5m)", "Diameter (furlong)"), "has the unit 'furlong', expected one of m, cm"},
      {replaced(good, "Diameter (\u00b5m)", "Diameter"), "'Equivalent Diameter' has no unit"},
      {replaced(good, "Particle ID", "Convexity (-)"), "are one figure"},
      {replaced(good, "0.9,", "white,"), "line 2: column 'Convexity (-)': expected a number, found 'white'"},
      {replaced(good, "0.9,", "nan,"), "expected a number, found 'nan'"},
      {replaced(good, "0.9,", ","), "expected a number, found ''"},
      {replaced(good, "0.9,", "-0.9,"), "convexity_volume_ratio is -0.9"},
      {replaced(good, "0.8,", "80,"), "sphericity_wadell is 80, expected above 0 to 1.5"},
      {good + "8,250,400\n", "line 12: has 3 cells"},
      // (I - S) / I is a flatness too.
      {replaced(good, "7,250,400,200,100", "7,250,400,200,150"), "another formula of that name"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string found = refusal(text);
    EXPECT_NE(found.find("sand.csv"), std::string::npos) << expected;
    EXPECT_NE(found.find(expected), std::string::npos) << "found: " << found << "\nexpected: " << expected;
  }
  EXPECT_THROW(read_form_table("nowhere.csv", ""), catalog::InputError);
  const TemporaryFolder folder;
  write_bytes(folder / "sand.csv", good);
  EXPECT_THROW(read_form_table(folder / "sand.csv", "volume > 0"), catalog::UsageError);
}

TEST(FormTable, NamesTheShapeThatLacksADescriptor) {
  try {
    form_row("rock_7", {{"equivalent_diameter_volume", 1e-3}});
    ADD_FAILURE() << "was taken";
  } catch (const catalog::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("rock_7: has no descriptor axis_intermediate_inertia"), std::string::npos);
  }
}

FormRow row_of(double diameter, double s_over_i, double i_over_l = 0.8) {
  return {diameter, s_over_i, i_over_l, 0.9, 0.8};
}

TEST(PopulationComparison, HasTheMomentsAndDistancesOfSmallSamples) {
  std::vector<FormRow> reference, made;
  for (int k = 1; k <= 9; ++k) reference.push_back(row_of(k, 0.1 * k, 1 - 0.1 * k));
  for (int k = 1; k <= 9; ++k) made.push_back(row_of(k + 4.5, 0.1 * k, 0.1 * k));
  const PopulationComparison comparison = compare_populations(reference, made, Samples::drawn_from_reference);
  const FigureComparison& diameter = comparison.figures[kDiameter];
  EXPECT_DOUBLE_EQ(diameter.reference.mean, 5);
  EXPECT_DOUBLE_EQ(diameter.reference.spread, std::sqrt(60.0 / 8));  // sum of squares over n - 1
  EXPECT_DOUBLE_EQ(diameter.reference.percentile_5, 1.4);
  EXPECT_DOUBLE_EQ(diameter.made.median, 9.5);
  EXPECT_DOUBLE_EQ(diameter.reference.percentile_95, 8.6);
  EXPECT_DOUBLE_EQ(diameter.mean_error, std::sqrt(60.0 / 8 / 9));
  EXPECT_DOUBLE_EQ(diameter.distance, 5.0 / 9);  // between 5 and 5.5: 5 of 9 against none
  EXPECT_FALSE(diameter.mean_agrees());
  EXPECT_TRUE(diameter.spread_agrees());
  EXPECT_DOUBLE_EQ(comparison.figures[kSOverI].distance, 0);
  EXPECT_FALSE(comparison.agrees());
  for (const CorrelationComparison& pair : comparison.correlations) {
    if (pair.second > kIOverL) {
      EXPECT_EQ(pair.reference, 0);  // what does not vary
    }
    if (pair.first == kSOverI && pair.second == kIOverL) {
      EXPECT_NEAR(pair.reference, -1, 1e-12);
      EXPECT_NEAR(pair.made, 1, 1e-12);
      EXPECT_FALSE(pair.agrees());
    }
  }
  EXPECT_TRUE(compare_populations(reference, reference, Samples::independent).agrees());
  // 0.1 k above 2/3: k = 7, 8, 9.
  EXPECT_EQ(comparison.made_classes, (std::array<std::size_t, 4>{3, 0, 0, 6}));
  EXPECT_EQ(comparison.reference_classes, (std::array<std::size_t, 4>{0, 3, 3, 3}));
}

TEST(ZinggClass, PartsTheFourAtTwoThirds) {
  EXPECT_STREQ(kZinggClasses[zingg_class(0.9, 0.9)], "sphere");
  EXPECT_STREQ(kZinggClasses[zingg_class(0.3, 0.9)], "disc");
  EXPECT_STREQ(kZinggClasses[zingg_class(0.9, 0.3)], "rod");
  EXPECT_STREQ(kZinggClasses[zingg_class(0.3, 0.3)], "blade");
}

TEST(CatalogListing, NamesZinggsClassWhereTheSidesAreKnown) {
  catalog::ShapeSummary rod, unknown;
  rod.descriptors = {{"zingg_s_over_i", 0.9}, {"zingg_i_over_l", 0.4}};
  EXPECT_NE(list_text({rod}).find(" rod "), std::string::npos);
  EXPECT_NE(list_json({rod}).find("\"zingg_class\": \"rod\""), std::string::npos);
  EXPECT_NE(list_json({unknown}).find("\"zingg_class\": null"), std::string::npos);
}

TEST(StratifiedRows, KeepTheDistributionCloserThanChance) {
  std::vector<FormRow> rows;
  RandomSource random(1);
  for (int k = 0; k < 4000; ++k) {
    const double size = random.uniform();
    rows.push_back(row_of(1 + size, 0.2 + 0.4 * size + 0.2 * random.uniform(), 0.2 + 0.7 * random.uniform()));
  }
  const std::vector<std::size_t> drawn = stratified_rows(rows, 200, 5);
  EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 200u);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end(), [&](auto a, auto b) { return rows[a][0] < rows[b][0]; }));
  EXPECT_EQ(drawn, stratified_rows(rows, 200, 5));
  EXPECT_NE(drawn, stratified_rows(rows, 200, 6));
  std::vector<FormRow> made;
  for (const std::size_t row : drawn) made.push_back(rows[row]);
  const PopulationComparison comparison = compare_populations(rows, made, Samples::drawn_from_reference);
  // Cells halve each of three figures twice or thrice: a quarter of the spread stays in each, so one standard error of
  // plain chance is four or more of these.
  for (const std::size_t figure : {kDiameter, kSOverI, kIOverL})
    EXPECT_LT(std::abs(comparison.figures[figure].made.mean - comparison.figures[figure].reference.mean),
              comparison.figures[figure].mean_error);
  EXPECT_TRUE(comparison.agrees());
}

TEST(RepresentativeRows, AreNearerThanOneDraw) {
  std::vector<FormRow> rows;
  RandomSource random(2);
  for (int k = 0; k < 1000; ++k)
    rows.push_back({1 + random.uniform(), random.uniform(), random.uniform(), random.uniform(), random.uniform()});
  const auto largest_correlation = [&](const std::vector<std::size_t>& drawn) {
    std::vector<FormRow> made;
    for (const std::size_t row : drawn) made.push_back(rows[row]);
    double largest = 0;
    for (const CorrelationComparison& pair :
         compare_populations(rows, made, Samples::drawn_from_reference).correlations)
      largest = std::max(largest, std::abs(pair.made - pair.reference));
    return largest;
  };
  double of_one = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) of_one += largest_correlation(stratified_rows(rows, 40, seed)) / 10;
  EXPECT_LT(largest_correlation(representative_rows(rows, 40, 1)), of_one);
}

TEST(StratifiedRows, TakeEachAsOftenAsItGoesWhole) {
  std::vector<FormRow> rows;
  for (int k = 0; k < 10; ++k) rows.push_back(row_of(k + 1, 0.5));
  const std::vector<std::size_t> drawn = stratified_rows(rows, 25, 1);
  ASSERT_EQ(drawn.size(), 25u);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto times = std::count(drawn.begin(), drawn.end(), row);
    EXPECT_TRUE(times == 2 || times == 3) << row;
  }
}

TEST(DistributionsSvg, HasAPanelForEachFigureWithItsName) {
  std::vector<FormRow> rows;
  for (int k = 1; k <= 10; ++k) rows.push_back(row_of(1e-3 * k, 0.05 * k));
  const std::string page = distributions_svg({"sand <1>", rows}, {"made", rows});
  for (const char* name : kFormNames) EXPECT_NE(page.find(name), std::string::npos) << name;
  EXPECT_NE(page.find("sand &lt;1&gt; (10)"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

}  // namespace
