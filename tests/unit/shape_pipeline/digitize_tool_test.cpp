// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize as a user runs it: exit statuses, batches, repetition.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/mesh_file.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using namespace test_support;

ToolRun digitize(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_DIGITIZE "' " + arguments);
}

TEST(DigitizeTool, ExitStatusesOfTheCommandLine) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  const ToolRun help = digitize(folder, "--help");
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.output.find("Example: talus digitize"), 0u) << help.output;
  EXPECT_EQ(digitize(folder, "--no-such-option").status, 2);
  EXPECT_EQ(digitize(folder, "box.stl --unit mm").status, 2);         // no catalogue
  EXPECT_EQ(digitize(folder, "--into a.talus --unit mm").status, 2);  // no scan
  const ToolRun no_unit = digitize(folder, "box.stl --into a.talus");
  EXPECT_EQ(no_unit.status, 2);
  EXPECT_NE(no_unit.errors.find("--unit"), std::string::npos);
  EXPECT_EQ(digitize(folder, "box.stl --into a.talus --unit parsec").status, 2);
  for (const char* size : {"1e150 km", "1e-30 mm", "0 mm", "nan"})
    EXPECT_EQ(digitize(folder, "box.stl --into a.talus --unit mm --size '" + std::string(size) + "'").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.talus"));
}

TEST(DigitizeTool, AScanGivenTwiceIsTakenOnce) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  shape_pipeline::write_stl(folder / "scans/box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  const ToolRun twice = digitize(folder, "scans/box.stl scans ./scans/../scans/box.stl --into a.talus --unit mm");
  EXPECT_EQ(twice.status, 0) << twice.errors;
  EXPECT_NE(twice.errors.find("box.stl: is given more than once; taken once"), std::string::npos) << twice.errors;
  catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  EXPECT_EQ(catalog.select("").size(), 1u);
}

TEST(DigitizeTool, ABatchGoesOnPastABadParticleAndIsIncremental) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  shape_pipeline::write_stl(folder / "scans/box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  shape_pipeline::write_stl(folder / "scans/ring.stl", torus(3, 1, 16));
  shape_pipeline::write_stl(folder / "scans/sphere.stl", uv_sphere(1, 12));
  write_text(folder / "scans/cut.ply", "ply\nformat ascii 1.0\n");
  const ToolRun first = digitize(folder, "scans nowhere.stl --into ore.talus --unit mm --json");
  EXPECT_EQ(first.status, 3);
  EXPECT_NE(first.errors.find("3 of 5 scans rejected or missing:"), std::string::npos) << first.errors;
  catalog::ShapeCatalog catalog(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  EXPECT_EQ(catalog.select("").size(), 2u);
  ASSERT_EQ(catalog.rejected().size(), 2u);  // the missing one is no scan
  EXPECT_NE(first.errors.find("nowhere: no such file"), std::string::npos) << first.errors;
  const std::string remedy = "state its handles with --genus";
  EXPECT_EQ(first.errors.find(remedy), first.errors.rfind(remedy)) << first.errors;
  const catalog::ShapeRecord box = catalog.shape(*catalog.find("box"));
  EXPECT_NEAR(box.mass_properties.volume, 6e-9, 1e-14);
  EXPECT_EQ(box.provenance.source_sha256, catalog::sha256_of_file(folder / "scans/box.stl"));
  EXPECT_FALSE(box.checks.empty());

  const ToolRun again = digitize(folder, "scans/box.stl scans/sphere.stl --into ore.talus --unit mm --json");
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_EQ(again.output.find("stored"), std::string::npos) << again.output;
  const ToolRun other_unit = digitize(folder, "scans/box.stl --into ore.talus --unit cm --json");
  EXPECT_NE(other_unit.output.find("stored"), std::string::npos) << other_unit.output;
}

TEST(DigitizeTool, AScanOfAnotherUnitThanTheOthersIsRejectedUnlessAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  for (int i = 1; i <= 3; ++i)
    shape_pipeline::write_stl(folder / ("scans/box" + std::to_string(i) + ".stl"),
                              box_mesh({0, 0, 0}, {1.0 * i, 2, 3}));
  shape_pipeline::write_stl(folder / "scans/inches.stl", box_mesh({0, 0, 0}, {1 / 25.4, 2 / 25.4, 3 / 25.4}));
  write_text(folder / "scans/stack.tif", "II");
  const ToolRun all = digitize(folder, "scans --into a.talus --unit mm");
  EXPECT_EQ(all.status, 3);
  EXPECT_NE(all.errors.find("scans: 1 CT stacks or images in it are passed over"), std::string::npos) << all.errors;
  EXPECT_NE(all.errors.find("inches.stl: is 0.0312 times as large as the median"), std::string::npos) << all.errors;
  {
    catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
    EXPECT_EQ(catalog.select("").size(), 3u);
    EXPECT_EQ(catalog.rejected().size(), 1u);
  }
  EXPECT_EQ(digitize(folder, "scans/inches.stl --into a.talus --unit in").status, 0);
  EXPECT_EQ(digitize(folder, "scans --into b.talus --unit mm --size '20 mm'").status, 0) << "all are made one size";
}

TEST(DigitizeTool, AMissingScanMakesNoCatalogue) {
  const TemporaryFolder folder;
  const ToolRun run = digitize(folder, "nowhere.stl --into ore.talus --unit mm");
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.errors.find("nowhere.stl: no such file; check the path"), std::string::npos) << run.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "ore.talus"));
}

TEST(DigitizeTool, LinksThatLeadNowhereAndPipesInAFolderAreListed) {
  const TemporaryFolder folder;
  const std::filesystem::path scans = folder / "scans";
  std::filesystem::create_directories(scans / "folder.stl");
  shape_pipeline::write_stl(scans / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  std::filesystem::create_symlink("box.stl", scans / "good_link.stl");
  std::filesystem::create_symlink("gone.stl", scans / "dead_link.stl");
  ASSERT_EQ(mkfifo((scans / "pipe.stl").c_str(), 0600), 0);
  const ToolRun run = digitize(folder, "scans --into ore.talus --unit mm --json");
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.errors.find("2 of 4 scans rejected or missing:"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("scans/dead_link.stl: is a link that leads nowhere (to gone.stl); mend or remove it"),
            std::string::npos)
      << run.errors;
  EXPECT_NE(run.errors.find("scans/pipe.stl: is no file but a pipe, socket, device or folder; copy the scan into"),
            std::string::npos)
      << run.errors;
  EXPECT_NE(run.output.find("\"good_link\",\"status\":\"stored\""), std::string::npos) << run.output;
}

TEST(DigitizeTool, AShapeWithACheckThatDidNotPassIsStoredAndNamedAndTheStatusIs4) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  // The truth is 6 mm3.
  write_text(folder / "truth.json", R"({"scans": [{"file": "box.stl", "volume": 9e-9, "surface_area": 22e-6}]})");
  for (const char* status : {"stored", "skipped"}) {
    const ToolRun run = digitize(folder, "box.stl --into ore.talus --unit mm --truth truth.json --json");
    EXPECT_EQ(run.status, 4) << run.errors;
    EXPECT_NE(run.output.find(status), std::string::npos) << run.output;
    EXPECT_NE(run.errors.find("1 of 1 scans stored with checks that did not pass"), std::string::npos) << run.errors;
    EXPECT_NE(run.errors.find("  box: volume_error_truth"), std::string::npos) << run.errors;
  }
  EXPECT_EQ(digitize(folder, "box.stl none.stl --into ore.talus --unit mm --truth truth.json").status, 3)
      << "a scan that cannot be used comes first";
}

TEST(DigitizeTool, WordsAndSeedsAreRefusedWithWhatIsAllowed) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& arguments, const std::string& message) {
    const ToolRun run = digitize(folder, arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.errors, "talus digitize: usage: " + message + "; see talus digitize --help\n");
  };
  expect("box.stl --method foo", "--method: expected auto, poisson or alpha-wrap, found 'foo'");
  expect("--make-virtual-scans v --seed -1",
         "--seed: expected a whole number from 0 to 18446744073709551615, found '-1'");
}

TEST(DigitizeTool, AFileOfAnotherKindIsNoCatalogue) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  for (const std::string& bytes : {std::string(), std::string("a letter"), std::string(5000, 'x')}) {
    write_text(folder / "letter", bytes);
    EXPECT_EQ(digitize(folder, "box.stl --into letter --unit mm").status, 3) << bytes.size();
    EXPECT_EQ(read_bytes(folder / "letter"), bytes);
  }
}

TEST(DigitizeTool, AShapeThatIsThereIsRejectedNoLonger) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "box.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  ASSERT_EQ(digitize(folder, "box.stl --into ore.talus --unit mm").status, 0);
  const std::string good = read_bytes(folder / "box.stl");
  write_text(folder / "box.stl", good.substr(0, 300));
  ASSERT_EQ(digitize(folder, "box.stl --into ore.talus --unit mm").status, 3);
  write_text(folder / "box.stl", good);
  const ToolRun again = digitize(folder, "box.stl --into ore.talus --unit mm");
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.output.find("skipped"), std::string::npos) << again.output;
  const catalog::ShapeCatalog catalog(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  EXPECT_TRUE(catalog.rejected().empty());
}

TEST(DigitizeTool, ALockedCatalogueIsNotTheScansFault) {
  const TemporaryFolder folder;
  shape_pipeline::write_stl(folder / "a.stl", box_mesh({0, 0, 0}, {1, 2, 3}));
  shape_pipeline::write_stl(folder / "b.stl", box_mesh({0, 0, 0}, {1, 1, 1}));
  ASSERT_EQ(digitize(folder, "a.stl --into ore.talus --unit mm").status, 0);
  sqlite3* writer = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "ore.talus").string().c_str(), &writer), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(writer, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  const ToolRun locked = digitize(folder, "a.stl b.stl --into ore.talus --unit mm --json");
  sqlite3_close(writer);
  EXPECT_EQ(locked.status, 3);
  EXPECT_NE(locked.errors.find("still locked"), std::string::npos) << locked.errors;
  EXPECT_EQ(locked.errors.find("rejected"), std::string::npos) << locked.errors;
  EXPECT_NE(locked.output.find("\"a\",\"status\":\"skipped\""), std::string::npos) << locked.output;
  EXPECT_EQ(locked.output.find("\"b\""), std::string::npos) << locked.output;
}

TEST(DigitizeTool, VirtualScansToTheSameCatalogueTwice) {
  const TemporaryFolder folder;
  ASSERT_EQ(digitize(folder, "--make-virtual-scans scans --count 2 --seed 5 --points 2500").status, 0);
  for (const char* name : {"a", "b"}) {
    const ToolRun run = digitize(
        folder, std::string("scans --truth scans/truth.json --unit m --size '30 mm' --json --into ") + name + ".talus");
    ASSERT_EQ(run.status, 0) << run.errors;
    write_text(folder / (std::string(name) + ".json"), run.output);
  }
  EXPECT_EQ(read_bytes(folder / "a.json"), read_bytes(folder / "b.json"));
  EXPECT_EQ(read_bytes(folder / "a.talus"), read_bytes(folder / "b.talus"));
  const catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  const catalog::ShapeRecord rock = catalog.shape(*catalog.find("rock_02"));
  EXPECT_NEAR(rock.descriptors.at("sieve_size_second_axis"), 0.03, 1e-9);
  EXPECT_LT(std::abs(rock.descriptors.at("volume_error_truth")), 0.02);
}

TEST(DigitizeTool, AStackBecomesNamedGrainsOnce) {
  const TemporaryFolder folder;
  std::string bytes;  // a cube of 16 voxels and one of 8
  for (int z = 0; z < 30; ++z)
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 50; ++x) {
        const bool is_large = std::min({x, y, z}) >= 6 && std::max({x, y, z}) < 22;
        const bool is_small = std::min({x - 26, y, z}) >= 10 && std::max({x - 26, y, z}) < 18;
        bytes += is_large || is_small ? '\xC8' : '\x28';
      }
  write_bytes(folder / "ct.raw", bytes);
  write_text(folder / "ct.json", R"({"size": [50, 30, 30], "type": "uint8"})");
  EXPECT_EQ(digitize(folder, "ct.raw ct.raw box.stl --into ore.talus --voxel '12 um'").status, 2);
  EXPECT_EQ(digitize(folder, "ct.raw --into ore.talus --voxel nan").status, 2);
  EXPECT_EQ(digitize(folder, "ct.raw --into ore.talus --voxel 12um --unit mm").status, 2);
  const ToolRun no_voxel = digitize(folder, "ct.raw --into ore.talus");
  EXPECT_EQ(no_voxel.status, 3);
  EXPECT_NE(no_voxel.errors.find("state it, such as --voxel '12 um'"), std::string::npos) << no_voxel.errors;

  const ToolRun first = digitize(folder, "ct.raw --into ore.talus --voxel '12 um'");
  EXPECT_EQ(first.status, 3) << first.errors;  // the small cube is refused by name
  EXPECT_NE(first.errors.find("ct_0002: grain ct_0002: 9.9 voxels a diameter"), std::string::npos) << first.errors;
  EXPECT_NE(first.errors.find("ct: 2 grains, 1 of them refused"), std::string::npos) << first.errors;
  catalog::ShapeCatalog catalog(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  const catalog::ShapeRecord grain = catalog.shape(*catalog.find("ct_0001"));
  // The cube's edges and corners are rounded by the filter and the surface between voxels: 12 edges by 0.1 voxel2.
  EXPECT_NEAR(grain.mass_properties.volume / std::pow(16 * 12e-6, 3), 1, 0.02);
  EXPECT_NE(grain.provenance.options.find("\"voxel\":\"12 um\""), std::string::npos) << grain.provenance.options;
  ASSERT_EQ(catalog.rejected().size(), 1u);
  EXPECT_EQ(catalog.rejected()[0].name, "ct_0002");

  const ToolRun again = digitize(folder, "ct.raw --into ore.talus --voxel '12 um' --json");
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_NE(again.output.find("\"status\":\"skipped\""), std::string::npos) << again.output;
  EXPECT_EQ(digitize(folder, "ct.raw --into ore.talus --voxel '12 um' --resolution 8").status, 0);
  EXPECT_TRUE(catalog.find("ct_0002").has_value());
  EXPECT_TRUE(catalog.rejected().empty());

  // Other options leave nothing of an earlier run behind, other sources stay.
  shape_pipeline::write_stl(folder / "ct_0003.stl", box_mesh({0, 0, 0}, {2, 3, 4}));
  EXPECT_EQ(digitize(folder, "ct_0003.stl --into ore.talus --unit mm").status, 0);
  const ToolRun coarse = digitize(folder, "ct.raw --into ore.talus --voxel '12 um' --sigma 0.6");
  EXPECT_NE(coarse.errors.find("ct: 1 of an earlier run removed (ct_0002)"), std::string::npos) << coarse.errors;
  EXPECT_NE(coarse.errors.find("ct: the catalogue keeps ct_0003 of another source"), std::string::npos);
  EXPECT_EQ(catalog.select("source_file = 'ct.raw'"), std::vector{*catalog.find("ct_0001")});
  EXPECT_EQ(catalog.rejected().at(0).name, "ct_0002");
  EXPECT_EQ(catalog.rejected().at(0).source_sha256.size(), 64u);
}

}  // namespace
