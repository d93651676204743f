// SPDX-License-Identifier: GPL-3.0-or-later
// talus-digitize on partial scans and on rocks on a plate, and talus-compare, as a user runs them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/rigid_motion.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/virtual_parts.h"
#include "shape_pipeline/virtual_scan.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"

namespace {

using namespace test_support;
namespace sp = shape_pipeline;

constexpr double kNoise = 3e-5;  // [m]; a rock is 0.03 m wide

ToolRun digitize(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_DIGITIZE "' " + arguments);
}

ToolRun compare(const TemporaryFolder& folder, const std::string& arguments) {
  return run(folder, "'" TALUS_COMPARE "' " + arguments);
}

TEST(CloudTool, PartsOfARockBecomeOneShape) {
  const TemporaryFolder folder;
  const catalog::TriangleMesh rock = sp::virtual_rock({});
  for (const sp::PartialScan& part : sp::virtual_parts(rock, 3, 2, kNoise).parts)
    sp::write_cloud(folder / part.name, part.cloud);
  const std::string order = "part1.ply part2.ply part3.ply --register --name rock --into a.talus --unit m";
  const ToolRun done = digitize(folder, order);
  ASSERT_EQ(done.status, 0) << done.errors;
  catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  const catalog::ShapeRecord shape = catalog.shape(*catalog.find("rock"));
  // As a whole scan of that noise.
  EXPECT_NEAR(shape.mass_properties.volume / sp::signed_volume(rock), 1, 0.005);
  EXPECT_NE(digitize(folder, order).output.find("skipped"), std::string::npos);

  EXPECT_EQ(digitize(folder, "part1.ply --register --into a.talus --unit m").status, 2);
  sp::PointCloud large = sp::read_cloud(folder / "part2.ply", {}).cloud;
  for (sp::Point& point : large.points) point = sp::scaled(point, 1000);
  sp::write_cloud(folder / "large.ply", large);
  const ToolRun units = digitize(folder, "part1.ply large.ply --register --name mixed --into a.talus --unit m");
  EXPECT_EQ(units.status, 3);
  EXPECT_NE(units.errors.find("large.ply is "), std::string::npos) << units.errors;
}

TEST(CloudTool, RocksOnAPlateBecomeShapes) {
  const TemporaryFolder folder;
  const sp::VirtualPlate plate = sp::virtual_plate(2, 3000, kNoise);
  sp::write_cloud(folder / "plate.ply", plate.cloud);
  const std::string order = "plate.ply --remove-plane --separate --into a.talus --unit m";
  const ToolRun done = digitize(folder, order);
  ASSERT_EQ(done.status, 0) << done.errors;
  catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
  double sum = 0;
  for (const char* name : {"plate_01", "plate_02"}) sum += catalog.summary(*catalog.find(name)).volume;
  // What is hidden under them is spanned smoothly.
  EXPECT_NEAR(sum / (plate.volumes[0] + plate.volumes[1]), 1, 0.02);
  EXPECT_NE(digitize(folder, order).output.find("skipped"), std::string::npos);

  const ToolRun small = digitize(folder, order + " --grain-points 2900 --name few");
  EXPECT_EQ(small.status, 3);
  EXPECT_NE(small.errors.find("few_01"), std::string::npos) << small.errors;
  sp::write_stl(folder / "rock.stl", sp::virtual_rock({}));
  const ToolRun mesh = digitize(folder, "rock.stl --remove-plane --into a.talus --unit m");
  EXPECT_EQ(mesh.status, 3);
  EXPECT_NE(mesh.errors.find("rock.stl: is a mesh"), std::string::npos) << mesh.errors;
}

TEST(CloudTool, ACloudTakenInAnotherWayLeavesNothingOfTheFirst) {
  const TemporaryFolder folder;
  sp::RockRecipe recipe;
  recipe.subdivisions = 3;
  sp::ScannerFlaws flaws;
  flaws.points = 1500;
  flaws.stray_points = 0;
  sp::write_cloud(folder / "one.ply", sp::virtual_scan(sp::virtual_rock(recipe), flaws));
  sp::write_stl(folder / "one_02.stl", sp::virtual_rock(recipe));
  const auto names = [&] {
    const catalog::ShapeCatalog catalog(folder / "a.talus", catalog::ShapeCatalog::Access::read_only);
    std::string text;
    for (const catalog::ShapeId id : catalog.select("")) text += catalog.summary(id).name + " ";
    return text;
  };
  ASSERT_EQ(digitize(folder, "one_02.stl one.ply --into a.talus --unit m").status, 0);
  EXPECT_EQ(names(), "one one_02 ");
  const ToolRun separated = digitize(folder, "one.ply --separate --into a.talus --unit m");
  EXPECT_EQ(names(), "one_01 one_02 ") << separated.errors;
  EXPECT_NE(separated.errors.find("one: 1 of an earlier run removed (one)"), std::string::npos) << separated.errors;
  const ToolRun whole = digitize(folder, "one.ply --into a.talus --unit m");
  EXPECT_EQ(names(), "one one_02 ") << whole.errors;
  EXPECT_NE(whole.errors.find("one: 1 of an earlier run removed (one_01)"), std::string::npos) << whole.errors;
}

TEST(CompareTool, TellsWhatTwoCapturesDifferBy) {
  const TemporaryFolder folder;
  sp::RockRecipe recipe;
  recipe.subdivisions = 4;
  const catalog::TriangleMesh rock = sp::virtual_rock(recipe);
  catalog::TriangleMesh other = rock;  // 2 % larger, turned, in millimetres
  for (sp::Point& vertex : other.vertices) vertex = sp::scaled(vertex, 1020);
  const sp::RigidMotion turn{{{{0.48, -0.8, 0.36}, {0.6, 0, -0.8}, {0.64, 0.6, 0.48}}}, {5, 0, 0}};
  sp::write_stl(folder / "first.stl", rock);
  sp::write_stl(folder / "second.stl", sp::moved(turn, other));
  const ToolRun done = compare(folder, "first.stl second.stl --unit m --second-unit mm --json --out map");
  ASSERT_EQ(done.status, 0) << done.errors;
  const nlohmann::json result = nlohmann::json::parse(done.output);
  // STL holds single precision.
  EXPECT_NEAR(result["figures"]["volume"]["relative_difference"].get<double>(), std::pow(1.02, 3) - 1, 1e-5);
  EXPECT_NEAR(result["figures"]["sphericity_wadell"]["relative_difference"].get<double>(), 0, 1e-5);
  // Growing by 2 % about the centre moves a surface by 2 % of its height over the centre: below half the diagonal.
  EXPECT_GT(result["distance_mean_signed"].get<double>(), 0);
  EXPECT_LT(result["distance_from_second"]["largest"].get<double>(), 0.01);
  EXPECT_GT(result["distance_from_second"]["mean"].get<double>(), 0.004);
  EXPECT_EQ(read_bytes(folder / "map/difference.vtp").find("<?xml"), 0u);
  const ToolRun units = compare(folder, "first.stl second.stl --unit m");
  EXPECT_EQ(units.status, 3);
  EXPECT_NE(units.errors.find("--second-unit"), std::string::npos) << units.errors;
}

}  // namespace
