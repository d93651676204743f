// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize on micrographs, as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "catalog/shape_catalog.h"
#include "tests/support/drawn_micrograph.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using namespace test_support;

ToolRun digitize(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_DIGITIZE "' " + arguments);
}

/// Sixteen ellipses in rows, one of them cut by the border.
DrawnMicrograph rows_of_grains() {
  DrawnMicrograph drawing;
  drawing.width = drawing.height = 240;
  for (int g = 0; g < 16; ++g)
    drawing.grains.push_back({35.0 + 58 * (g % 4), 35.0 + 58 * (g / 4), 20.0 + g % 5, 16.0 + g % 3, 0.7 * g});
  drawing.grains.push_back({0, 120, 6, 6});
  return drawing;
}

TEST(DigitizeMicrographs, GivesTablesOutlinesOverlayAndAPopulationOnce) {
  const TemporaryFolder folder;
  write_drawn(folder / "powder.png", rows_of_grains());
  const std::string arguments = "powder.png --into ore.talus --pixel '0.5 um' --population 2";
  const ToolRun first = digitize(folder, arguments);
  ASSERT_EQ(first.status, 0) << first.errors;
  EXPECT_NE(first.errors.find("16 whole grains; left out: 1 cut by the border"), std::string::npos) << first.errors;
  const std::string table = read_bytes(folder / "ore_outlines" / "powder.csv");
  EXPECT_EQ(table.find("grain[-],image[-],middle_x[m],middle_y[m],area_imagej[m2],perimeter_imagej[m]"), 0u);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 17);
  EXPECT_NE(read_bytes(folder / "ore_outlines" / "powder.json").find("\"cut_by_border\":[["), std::string::npos);
  EXPECT_EQ(read_bytes(folder / "ore_outlines" / "powder.png").substr(1, 3), "PNG");
  EXPECT_NE(read_bytes(folder / "ore_outlines" / "powder_population.json").find("S/I drawn"), std::string::npos);

  catalog::ShapeCatalog ore(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  const catalog::ShapeRecord grain = ore.shape(*ore.find("powder_0002"));
  EXPECT_NE(grain.provenance.options.find("third_axis"), std::string::npos) << grain.provenance.options;
  const auto assumed = std::find_if(grain.checks.begin(), grain.checks.end(),
                                    [](const catalog::Check& check) { return check.name == "assumed_third_axis"; });
  ASSERT_NE(assumed, grain.checks.end());
  EXPECT_NE(assumed->detail.find("S/I drawn"), std::string::npos) << assumed->detail;

  EXPECT_NE(digitize(folder, arguments).output.find("skipped"), std::string::npos);
  EXPECT_EQ(read_bytes(folder / "ore_outlines" / "powder.csv"), table);
  EXPECT_NE(digitize(folder, arguments + " --seed 2").output.find("stored"), std::string::npos);
}

TEST(DigitizeMicrographs, OthersGoOnPastABadImage) {
  const TemporaryFolder folder;
  write_drawn(folder / "b_good.png", rows_of_grains());
  write_bytes(folder / "a_empty.png", "");
  write_uniform(folder / "c_black.png", 64, 64, 0);
  const ToolRun run =
      digitize(folder, "a_empty.png b_good.png ./b_good.png c_black.png --out tables --population 0 --pixel '1 um'");
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.errors.find("a_empty.png: is empty"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("c_black.png: is black"), std::string::npos) << run.errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "tables" / "b_good.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tables" / "c_black.csv"));
}

TEST(DigitizeMicrographs, BadOptionsAreRefused) {
  const TemporaryFolder folder;
  write_drawn(folder / "powder.png", rows_of_grains());
  for (const char* pixel : {"0 um", "-1 um", "nan", "inf", "1 parsec"}) {
    const ToolRun run = digitize(folder, "powder.png --into ore.talus --pixel='" + std::string(pixel) + "'");
    EXPECT_EQ(run.status, 2) << pixel;
    EXPECT_NE(run.errors.find("--pixel"), std::string::npos) << run.errors;
  }
  const ToolRun no_size = digitize(folder, "powder.png --into ore.talus");
  EXPECT_EQ(no_size.status, 3);
  EXPECT_NE(no_size.errors.find("powder.png"), std::string::npos);
  EXPECT_NE(no_size.errors.find("--scale-bar"), std::string::npos) << no_size.errors;
  EXPECT_EQ(digitize(folder, "powder.png --into ore.talus --scale-bar '10 um'").status, 3);  // there is none
  EXPECT_EQ(digitize(folder, "powder.png --into ore.talus --pixel '1 um' --third-axis 1.5").status, 2);
  EXPECT_EQ(digitize(folder, "powder.png --into ore.talus --pixel '1 um' --scale-bar '10 um'").status, 2);
  EXPECT_EQ(digitize(folder, "powder.png --pixel '1 um'").status, 2);               // no place for the tables
  EXPECT_EQ(digitize(folder, "powder.png --pixel '1 um' --out tables").status, 2);  // no catalogue for the population
  EXPECT_EQ(digitize(folder, "powder.png --into ore.talus --pixel '1 um' --unit mm").status, 2);
  EXPECT_EQ(digitize(folder, "powder.png rock.stl --into ore.talus --unit mm").status, 2);
}

}  // namespace
