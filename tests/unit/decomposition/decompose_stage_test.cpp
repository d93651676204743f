// SPDX-License-Identifier: GPL-3.0-or-later
// talus-decompose on small catalogues, through its library and as a user starts it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "catalog/input_error.h"
#include "tests/support/solids.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tool_run.h"
#include "workflows/decompose_batch.h"

namespace workflows {
namespace {

using test_support::TemporaryFolder;

catalog::ShapeRecord shape(const std::string& name, const catalog::TriangleMesh& mesh) {
  catalog::ShapeRecord record;
  record.name = name;
  record.mesh = mesh;
  record.mass_properties = catalog::mass_properties(mesh);
  record.provenance = {name + ".ply", std::string(64, 'a'), "talus test", "{}"};
  return record;
}

catalog::ShapeCatalog small_catalog(const std::filesystem::path& path) {
  catalog::ShapeCatalog shapes(path, catalog::ShapeCatalog::Access::read_write);
  catalog::TriangleMesh open = solids::tetrahedron();
  open.faces.pop_back();
  shapes.store_shape(shape("angle", solids::l_shape()));
  shapes.store_shape(shape("broken", open));
  shapes.store_shape(shape("cube", solids::box({0, 0, 0}, {1, 1, 1})));
  return shapes;
}

DecomposeBatchOptions one_and_two() {
  DecomposeBatchOptions options;
  options.part_counts = {1, 2};
  return options;
}

int run(const std::string& arguments, const TemporaryFolder& folder) {
  return test_support::run(folder, "'" TALUS_DECOMPOSE "' " + arguments).status;
}

TEST(DecomposeStage, StoresLevelsAndGoesOnPastABadShape) {
  const TemporaryFolder folder;
  catalog::ShapeCatalog shapes = small_catalog(folder / "ore.talus");
  std::vector<std::string> seen;
  const DecomposeBatchResult result =
      decompose_shapes(shapes, one_and_two(), [&](const std::string& name, std::size_t of) {
        EXPECT_EQ(of, 3u);
        seen.push_back(name);
      });
  EXPECT_EQ(seen, (std::vector<std::string>{"angle", "broken", "cube"}));
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].shape, "broken");
  EXPECT_EQ(result.levels.size(), 4u);
  const catalog::LevelOfDetail level = shapes.level(*shapes.find("angle"), {2, 32});
  EXPECT_EQ(level.parts.size(), 2u);
  EXPECT_NEAR(level.error.symmetric_difference, 0, 1e-9);
  EXPECT_EQ(level.provenance.source_sha256.size(), 64u);
}

TEST(DecomposeStage, KeepsWhatIsCurrentAndRemakesWhatIsNot) {
  const TemporaryFolder folder;
  catalog::ShapeCatalog shapes = small_catalog(folder / "ore.talus");
  const auto quietly = [](const std::string&, std::size_t) {};
  DecomposeBatchOptions options = one_and_two();
  options.select = "name = 'cube'";
  const auto made_new = [&] {
    int count = 0;
    for (const DecomposedLevel& level : decompose_shapes(shapes, options, quietly).levels) count += level.is_new;
    return count;
  };
  EXPECT_EQ(made_new(), 2);
  EXPECT_EQ(made_new(), 0);
  options.part_counts = {1, 2, 4};
  EXPECT_EQ(made_new(), 1);
  options.vertex_caps = {16, 32};
  EXPECT_EQ(made_new(), 3) << "a ladder of its own for the new cap";
  EXPECT_EQ(shapes.summary(*shapes.find("cube")).levels.size(), 6u);
  options.vertex_caps = {32};
  options.quality.mode = catalog::FitMode::enclosing;
  EXPECT_EQ(made_new(), 3);
  options.quality.face_cap = 24;
  EXPECT_EQ(made_new(), 3);
  options.quality.mode = catalog::FitMode::volume_true;
  options.quality.face_cap = 0;
  EXPECT_EQ(made_new(), 0) << "other modes and caps have a place of their own";
  EXPECT_EQ(shapes.summary(*shapes.find("cube")).levels.size(), 12u);
  options.quality.seed = 5;
  EXPECT_EQ(made_new(), 3);
  EXPECT_EQ(shapes.summary(*shapes.find("cube")).levels.size(), 12u) << "another seed has not";
  options.quality.smallest_volume = 0.02;
  EXPECT_EQ(made_new(), 3);
  options.quality.smallest_thickness = 0.2;
  EXPECT_EQ(made_new(), 3);
  options.quality.time_budget = 0.01;
  EXPECT_EQ(made_new(), 3);
  EXPECT_EQ(made_new(), 0) << "a level made in a time is kept for the same time";
  options.quality.time_budget = 0;
  catalog::ShapeRecord other = shape("cube", solids::box({0, 0, 0}, {1, 1, 2}));
  shapes.store_shape(other);
  EXPECT_EQ(made_new(), 3);
}

TEST(DecomposeStage, ARefusedLevelLosesNoOther) {
  const TemporaryFolder folder;
  const auto box_at = [](double x) { return solids::box({x, 0, 0}, {x + 1, 1, 1}); };
  {
    catalog::ShapeCatalog shapes(folder / "ore.talus", catalog::ShapeCatalog::Access::read_write);
    shapes.store_shape(shape("row", solids::together({box_at(0), box_at(5), box_at(10)})));
    DecomposeBatchOptions options;
    options.part_counts = {1, 3};
    options.vertex_caps = {16, 32};
    options.quality.time_budget = 0.02;
    const DecomposeBatchResult result = decompose_shapes(shapes, options, [](const std::string&, std::size_t) {});
    ASSERT_EQ(result.levels.size(), 2u);
    ASSERT_EQ(result.failures.size(), 2u);
    EXPECT_EQ(result.failures[1].level->vertex_cap, 32);
    const std::string text = failure_text(result.failures[0]);
    EXPECT_NE(text.find("row: 1 part of 16 vertices: not made: mesh: "), std::string::npos) << text;
    EXPECT_NE(text.find("at least 3 parts"), std::string::npos) << text;
    const catalog::LevelOfDetail level = shapes.level(*shapes.find("row"), {3, 16});
    EXPECT_EQ(level.parts.size(), 3u);
    EXPECT_NE(level.provenance.options.find("\"time_budget\":0.01,"), std::string::npos) << "both caps share it";
    EXPECT_EQ(shapes.summary(*shapes.find("row")).levels.size(), 2u);
  }
  EXPECT_EQ(run("'" + (folder / "ore.talus").string() + "' --parts 1,3 --json", folder), 3);
  const auto json = nlohmann::json::parse(test_support::read_bytes(folder / "out"));
  EXPECT_EQ(json["levels"].size(), 1u);
  EXPECT_EQ(json["failures"][0]["parts_asked"], 1);
}

TEST(DecomposeStage, OptionsThatDoNotFitAreUsageErrors) {
  const TemporaryFolder folder;
  { small_catalog(folder / "ore.talus"); }
  const std::string cube = "'" + (folder / "ore.talus").string() + "' --select \"name = 'cube'\" --parts 1 ";
  EXPECT_EQ(run(cube + "--effort 2 --time-budget 3", folder), 2);
  EXPECT_NE(test_support::read_bytes(folder / "err").find("give one of them"), std::string::npos);
  for (const std::string share : {"1", "-0.1", "nan", "thick"}) {
    EXPECT_EQ(run(cube + "--smallest-thickness " + share, folder), 2) << share;
    EXPECT_EQ(run(cube + "--smallest-volume " + share, folder), 2) << share;
  }
  EXPECT_EQ(run(cube + "--smallest-thickness 0.2 --smallest-volume 0.03", folder), 0);
  catalog::ShapeCatalog shapes(folder / "ore.talus", catalog::ShapeCatalog::Access::read_only);
  EXPECT_NE(shapes.level(*shapes.find("cube"), {1, 32})
                .provenance.options.find("\"smallest_thickness\":0.20000000000000001,\"smallest_volume\":0.029"),
            std::string::npos);
  test_support::write_bytes(folder / "rock.stl", "solid");
  EXPECT_EQ(run("'" + (folder / "rock.stl").string() + "'", folder), 3);
  EXPECT_NE(test_support::read_bytes(folder / "err").find("rock.stl --unit mm --into ore.talus"), std::string::npos);
}

TEST(DecomposeStage, ALevelWithoutTheErrorsOfTodayIsMadeAnew) {
  const TemporaryFolder folder;
  catalog::ShapeCatalog shapes = small_catalog(folder / "ore.talus");
  DecomposeBatchOptions options = one_and_two();
  options.select = "name = 'angle'";
  const auto quietly = [](const std::string&, std::size_t) {};
  decompose_shapes(shapes, options, quietly);
  const catalog::ShapeId id = *shapes.find("angle");
  const catalog::LevelOfDetail made = shapes.level(id, {1, 32});
  catalog::LevelOfDetail old = made;
  old.error.surface.percentile_95 = old.error.convexity_error = std::numeric_limits<double>::quiet_NaN();
  shapes.store_levels(id, {old});
  const DecomposeBatchResult result = decompose_shapes(shapes, options, quietly);
  EXPECT_TRUE(result.levels[0].is_new);
  EXPECT_FALSE(result.levels[1].is_new);
  EXPECT_EQ(shapes.level(id, {1, 32}).error, made.error);
}

TEST(DecomposeStage, QueryThatSelectsNothingIsRefused) {
  const TemporaryFolder folder;
  catalog::ShapeCatalog shapes = small_catalog(folder / "ore.talus");
  DecomposeBatchOptions options = one_and_two();
  options.select = "volume > 1000";
  EXPECT_THROW(decompose_shapes(shapes, options, [](const std::string&, std::size_t) {}), catalog::InputError);
}

TEST(DecomposeStage, ExitStatusesAndJson) {
  const TemporaryFolder folder;
  { small_catalog(folder / "ore.talus"); }
  const std::string catalog = "'" + (folder / "ore.talus").string() + "'";
  EXPECT_EQ(run(catalog + " --parts 1,2 --json", folder), 3);  // one shape is broken
  const auto json = nlohmann::json::parse(test_support::read_bytes(folder / "out"));
  EXPECT_EQ(json["levels"].size(), 4u);
  EXPECT_EQ(json["failures"][0]["shape"], "broken");
  EXPECT_NE(test_support::read_bytes(folder / "err").find("broken: not decomposed: mesh: "), std::string::npos);
  EXPECT_EQ(run(catalog + " --parts 1,2 --select \"name like 'cube'\"", folder), 0);
  EXPECT_NE(test_support::read_bytes(folder / "out").find("kept"), std::string::npos);
  EXPECT_EQ(run("--help", folder), 0);
  EXPECT_EQ(run(catalog + " --vertices 400", folder), 2);
  EXPECT_EQ(run(catalog + " --no-such-option", folder), 2);
  EXPECT_EQ(run(catalog + " --mode outside", folder), 2);
  EXPECT_EQ(run(catalog + " --faces 5", folder), 2);
  EXPECT_EQ(run(catalog + " --parts 1 --mode enclosing --faces 12 --select \"name like 'angle'\" --json", folder), 0);
  const auto enclosing = nlohmann::json::parse(test_support::read_bytes(folder / "out"))["levels"][0];
  EXPECT_LT(enclosing["missing_volume"], 1e-12) << "rounding of the measurement";
  EXPECT_TRUE(enclosing["new"]) << "another mode is another level";
  EXPECT_EQ(run("'" + (folder / "none.talus").string() + "'", folder), 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "none.talus"));
  EXPECT_EQ(run(catalog + " --select \"volume > 1000\"", folder), 3);
  EXPECT_NE(test_support::read_bytes(folder / "err").find("ore.talus: --select"), std::string::npos);
}

TEST(DecomposeStage, AFileOfAnotherKindStaysAsItIs) {
  const TemporaryFolder folder;
  for (const std::string& bytes : {std::string(), std::string("x"), std::string(5000, 'x')}) {
    test_support::write_bytes(folder / "letter", bytes);
    EXPECT_EQ(run("'" + (folder / "letter").string() + "'", folder), 3) << bytes.size();
    EXPECT_EQ(test_support::read_bytes(folder / "letter"), bytes);
  }
}

}  // namespace
}  // namespace workflows
