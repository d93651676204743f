// SPDX-License-Identifier: GPL-3.0-or-later
// talus-generate and talus-family as a user runs them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "catalog/shape_catalog.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using test_support::run;
using test_support::TemporaryFolder;
using test_support::ToolRun;

const std::string kGenerate = "'" TALUS_GENERATE "' ", kFamily = "'" TALUS_FAMILY "' ";

TEST(GenerateTool, StoresASolidAndItsFamilyOnceWithProvenance) {
  const TemporaryFolder folder;
  const std::string rocks = "crushed-rock --count 2 --seed 5 --into a.talus --size '12 mm'";
  EXPECT_EQ(run(folder, kGenerate + rocks).status, 0);
  EXPECT_NE(run(folder, kGenerate + rocks).output.find("skipped"), std::string::npos);
  EXPECT_EQ(run(folder, kFamily + "stretch a.talus crushed-rock_001 --s-over-i 0.5 --i-over-l 0.8 --name flat").status,
            0);
  catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  const catalog::ShapeRecord flat = catalog.shape(*catalog.find("flat"));
  EXPECT_EQ(flat.provenance.source_file, "crushed-rock_001");
  EXPECT_EQ(flat.provenance.source_sha256.size(), 64u);
  EXPECT_NE(flat.provenance.options.find("\"s_over_i\":0.5"), std::string::npos);
  EXPECT_NEAR(flat.descriptors.at("zingg_s_over_i"), 0.5, 1e-6);
  const catalog::ShapeRecord second = catalog.shape(*catalog.find("crushed-rock_002"));
  EXPECT_NE(second.provenance.options.find("\"seed\":6"), std::string::npos);
  EXPECT_NEAR(second.descriptors.at("sieve_size_second_axis"), 0.012, 1e-9);
}

TEST(GenerateTool, RefusesByName) {
  const TemporaryFolder folder;
  const ToolRun unknown = run(folder, kGenerate + "cubee --into a.talus --size '1 mm'");
  EXPECT_EQ(unknown.status, 3);
  EXPECT_NE(unknown.errors.find("did you mean 'cube'"), std::string::npos);
  const ToolRun size = run(folder, kGenerate + "cube --into a.talus --size '1 kg'");
  EXPECT_EQ(size.status, 2);
  EXPECT_NE(size.errors.find("--size: expected a length"), std::string::npos);
  EXPECT_EQ(run(folder, kGenerate + "cube --into a.talus").status, 2);
  EXPECT_EQ(run(folder, kGenerate + "cube --count 2 --into a.talus --size '1 mm'").status, 2);
  EXPECT_EQ(run(folder, kFamily + "stretch none.talus cube --s-over-i 1 --i-over-l 1").status, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.talus"));
  ASSERT_EQ(run(folder, kGenerate + "cube --into a.talus --size '1 mm'").status, 0);
  const ToolRun ratio = run(folder, kFamily + "stretch a.talus cube --s-over-i 1.5 --i-over-l 1");
  EXPECT_EQ(ratio.status, 3);
  EXPECT_NE(ratio.errors.find("S/I: expected a ratio of 0.01 to 1"), std::string::npos);
  EXPECT_EQ(run(folder, kFamily + "low-pass a.talus sphere --degree 3").status, 3);
}

}  // namespace
