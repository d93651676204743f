// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize on turntable images, as a user runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/virtual_scan.h"
#include "shape_pipeline/virtual_turntable.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using namespace test_support;

ToolRun digitize(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_DIGITIZE "' --turntable " + arguments);
}

/// Ten views, so that view_10 comes after view_9.
void write_views(const std::filesystem::path& folder) {
  shape_pipeline::RockRecipe rock;
  rock.subdivisions = 2;
  shape_pipeline::TurntableRecipe recipe;
  recipe.views = 10;
  recipe.side = 96;
  shape_pipeline::write_turntable(folder, shape_pipeline::virtual_turntable(virtual_rock(rock), recipe));
}

TEST(DigitizeTurntable, StoresTheHullOnceAndNamesBadViews) {
  const TemporaryFolder folder;
  write_views(folder / "rock");
  const std::string arguments = "rock/ --into ore.talus --cells 40";
  const ToolRun first = digitize(folder, arguments);
  ASSERT_EQ(first.status, 0) << first.errors;
  EXPECT_NE(first.output.find("stored"), std::string::npos) << first.output;
  EXPECT_NE(digitize(folder, arguments).output.find("skipped"), std::string::npos);

  const std::string whole = read_bytes(folder / "rock" / "view_4.png");
  write_bytes(folder / "rock" / "view_4.png", whole.substr(0, whole.size() / 2));
  const ToolRun cut = digitize(folder, arguments);
  EXPECT_EQ(cut.status, 4) << cut.errors;
  EXPECT_NE(cut.errors.find("view_4.png: ends before its last pixels do"), std::string::npos) << cut.errors;
  EXPECT_NE(cut.errors.find("turntable_views"), std::string::npos) << cut.errors;
  catalog::ShapeCatalog ore(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  EXPECT_NE(ore.shape(*ore.find("rock")).provenance.options.find("\"turntable\":true"), std::string::npos);
}

TEST(DigitizeTurntable, RefusalsNameTheFolderAndOthersGoOn) {
  const TemporaryFolder folder;
  write_views(folder / "rock");
  write_views(folder / "unscaled");
  std::filesystem::remove(folder / "unscaled" / "turntable.json");
  std::filesystem::create_directory(folder / "empty");
  const ToolRun run = digitize(folder, "empty nowhere unscaled rock --into ore.talus --cells 40");
  EXPECT_EQ(run.status, 3);
  for (const char* reason : {"empty: no images", "nowhere: is no folder", "unscaled: the length scale is not known"})
    EXPECT_NE(run.errors.find(reason), std::string::npos) << run.errors;
  EXPECT_NE(run.output.find("stored"), std::string::npos) << run.output;
  EXPECT_EQ(digitize(folder, "unscaled --into ore.talus --cells 40 --pixel '20 um'").status, 0);
  const ToolRun differs = digitize(folder, "rock --into other.talus --pixel '20 um'");
  EXPECT_EQ(differs.status, 3);
  EXPECT_NE(differs.errors.find("another pixel size than --pixel"), std::string::npos) << differs.errors;
  for (const char* arguments : {"rock", "rock --into o.talus --pixel 0", "rock --into o.talus --unit mm",
                                "rock --into o.talus --stack", "rock --into o.talus --cells 4"})
    EXPECT_EQ(digitize(folder, arguments).status, 2) << arguments;
}

}  // namespace
