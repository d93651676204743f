// SPDX-License-Identifier: GPL-3.0-or-later
// talus family population and talus catalog compare as a user runs them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"
#include "workflows/shape_sampling.h"

namespace {

using test_support::read_bytes;
using test_support::run;
using test_support::TemporaryFolder;
using test_support::ToolRun;
using test_support::write_bytes;

const std::string kFamily = "'" TALUS_FAMILY "' ", kCatalog = "'" TALUS_CATALOG "' ";
constexpr int kCount = 20;

/// Grains whose S/I falls with their size (correlation -0.9) and whose I/L does not follow it.
std::string made_reference() {
  workflows::RandomSource random(1);
  std::string text =
      "equivalent_diameter_volume [mm],s_over_i_inertia,i_over_l_inertia,convexity_volume_ratio,"
      "sphericity_wadell\n";
  for (int k = 0; k < 400; ++k) {
    const double size = random.uniform(), other = random.uniform(), convexity = 0.88 + 0.06 * random.uniform();
    const double s_over_i = 0.95 - 0.2 * size - 0.097 * other;
    text += std::to_string(1 + size) + "," + std::to_string(s_over_i) + "," +
            std::to_string(0.75 + 0.25 * random.uniform()) + "," + std::to_string(convexity) + "," +
            std::to_string(convexity - 0.03) + "\n";
  }
  return text;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
    syy += y[k] * y[k];
  }
  return (sxy - sx * sy / n) / std::sqrt((sxx - sx * sx / n) * (syy - sy * sy / n));
}

TEST(FamilyPopulation, FindsTheCorrelationsOfAMadeReferenceAgain) {
  const TemporaryFolder folder;
  write_bytes(folder / "sand.csv", made_reference());
  const std::string command = kFamily + "population sand.csv --seed 3 --count " + std::to_string(kCount) + " --into ";
  const ToolRun first = run(folder, command + "a.talus --plot a.svg --threads 1");
  ASSERT_EQ(first.status, 0) << first.output << first.errors;
  EXPECT_NE(first.output.find("population_targets"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "a.svg").find("</svg>"), std::string::npos);

  std::vector<double> size, flatness, elongation, convexity, sphericity;
  catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  for (const catalog::ShapeId id : catalog.select("")) {
    const catalog::ShapeRecord shape = catalog.shape(id);
    const auto& figures = shape.descriptors;
    size.push_back(figures.at("equivalent_diameter_volume"));
    flatness.push_back(figures.at("axis_short_inertia") / figures.at("axis_intermediate_inertia"));
    elongation.push_back(figures.at("axis_intermediate_inertia") / figures.at("axis_long_inertia"));
    convexity.push_back(figures.at("convexity_volume_ratio"));
    sphericity.push_back(figures.at("sphericity_wadell"));
    EXPECT_EQ(shape.provenance.source_file, "sand.csv");
    EXPECT_EQ(shape.provenance.source_sha256, catalog::sha256_of_file(folder / "sand.csv"));
    EXPECT_NE(shape.provenance.options.find("\"seed\":3"), std::string::npos);
  }
  ASSERT_EQ(size.size(), static_cast<std::size_t>(kCount));
  // Three standard errors (1 - r^2) / sqrt(20) of the correlations that the reference was made with.
  EXPECT_NEAR(correlation(size, flatness), -0.9, 0.13);
  EXPECT_NEAR(correlation(convexity, sphericity), 1, 0.02);  // both targets are met to 0.001 of a spread of 0.017
  EXPECT_NEAR(correlation(size, elongation), 0, 0.67);

  // Run again: nothing is made; on two threads: the same bytes.
  const std::string bytes = read_bytes(folder / "a.talus");
  const ToolRun again = run(folder, command + "a.talus --json");
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(nlohmann::json::parse(again.output)["shapes"][0]["status"], "skipped");
  EXPECT_EQ(read_bytes(folder / "a.talus"), bytes);
  EXPECT_EQ(run(folder, command + "b.talus --threads 2").status, 0);
  EXPECT_EQ(read_bytes(folder / "b.talus"), bytes);

  const ToolRun compared = run(folder, kCatalog + "compare a.talus --reference sand.csv --json --plot b.svg");
  EXPECT_EQ(compared.status, 0) << compared.errors;
  const auto figures = nlohmann::json::parse(compared.output)["figures"];
  EXPECT_TRUE(figures["sphericity_wadell"]["agrees"]);
  EXPECT_EQ(figures.size(), 5u);
  EXPECT_NE(read_bytes(folder / "b.svg").find("</svg>"), std::string::npos);
  // A catalogue is a reference too.
  EXPECT_EQ(run(folder, kFamily + "population a.talus --count 10 --into c.talus").status, 0);
}

TEST(FamilyPopulation, RefusesByName) {
  const TemporaryFolder folder;
  write_bytes(folder / "empty.csv", "");
  write_bytes(folder / "sand.csv", made_reference());
  const ToolRun empty = run(folder, kFamily + "population empty.csv --count 10 --into a.talus");
  EXPECT_EQ(empty.status, 3);
  EXPECT_NE(empty.errors.find("empty.csv: is empty"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.talus"));
  EXPECT_EQ(run(folder, kFamily + "population sand.csv --count 1 --into a.talus").status, 2);
  EXPECT_EQ(run(folder, kFamily + "population sand.csv --count 10 --into a.talus --select 'volume > 0'").status, 2);
  EXPECT_EQ(run(folder, kFamily + "population sand.csv --count 10 --into sand.csv").status, 3);
}

}  // namespace
