// SPDX-License-Identifier: Apache-2.0
// Catalogues of older schemas are brought forward, or read as they are.
#include "tests/unit/catalog/catalog_files.h"

#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog_files;
using test_support::TemporaryFolder;

/// A file as an older schema wrote it, with the rows of `model`. Shapes and levels had fewer columns then.
void make_old_schema(const fs::path& path, const fs::path& model, const std::vector<std::string>& migrations) {
  Sqlite old(path);
  for (const std::string& migration : migrations) {
    std::ifstream file(fs::path(TALUS_SOURCE_DIR) / "catalog/migrations" / migration);
    const std::string schema{std::istreambuf_iterator<char>(file), {}};
    ASSERT_FALSE(schema.empty());
    old.execute(schema);
  }
  old.execute("PRAGMA application_id = 0x54616c73; PRAGMA user_version = " + std::to_string(migrations.size()));
  old.execute("ATTACH '" + model.string() + "' AS model");
  old.execute(
      "INSERT INTO main.shapes SELECT id, name, volume, centroid_x, centroid_y, centroid_z, principal_inertia_1, "
      "principal_inertia_2, principal_inertia_3, mass_properties, source_file, source_sha256, tool_version, options "
      "FROM model.shapes");
  for (const std::string table : {"meshes", "descriptors", "checks", "rejected"})
    old.execute("INSERT INTO main." + table + " SELECT * FROM model." + table);
  old.execute(
      "INSERT INTO main.levels SELECT id, shape_id, parts_asked, vertex_cap, part_count, volume, centroid_x, "
      "centroid_y, centroid_z, principal_inertia_1, principal_inertia_2, principal_inertia_3, mass_properties, "
      "symmetric_difference, missing_volume, volume_error, surface_mean, surface_max, overlap, method_error, "
      "source_file, source_sha256, tool_version, options FROM model.levels");
  old.execute("INSERT INTO main.parts SELECT * FROM model.parts");
}

void make_schema_1(const fs::path& path, const fs::path& model) { make_old_schema(path, model, {"0001_shapes.sql"}); }

TEST(CatalogFile, OldSchemaIsBroughtForwardAfterACopy) {
  const TemporaryFolder folder;
  make_catalog(folder / "model.talus", 2);
  make_schema_1(folder / "ore.talus", folder / "model.talus");
  {
    const ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
    EXPECT_GE(catalog.schema_version(), 2);
    EXPECT_EQ(catalog.select("sphericity_wadell > 0").size(), 2u);
    EXPECT_EQ(catalog.level(*catalog.find("rock_1"), {2, 64}).parts.size(), 2u);
  }
  Sqlite kept(folder / "ore.talus.schema-1");
  EXPECT_EQ(kept.value("PRAGMA user_version"), "1");
  EXPECT_EQ(kept.value("PRAGMA integrity_check"), "ok");
  EXPECT_EQ(kept.value("SELECT count(*) FROM shapes"), "2");
  // Opening it again migrates nothing and keeps no second copy.
  ShapeCatalog(folder / "ore.talus", Access::read_write);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3);
}

TEST(CatalogFile, LevelsOfSchema2KeepTheirPartsAndGetModeAndFaceCapFromTheirOptions) {
  const TemporaryFolder folder;
  const ShapeRecord shape = sample_shape("rock");
  const struct {
    std::string options;
    LevelKey key;
  } cases[] = {
      {R"({"options":{"parts":1,"face_cap":0,"mode":"volume-true"}})", {1, 64, 0, FitMode::volume_true}},
      {R"({"options":{"parts":2,"face_cap":34,"mode":"enclosing"}})", {2, 64, 34, FitMode::enclosing}},
      {R"({"options":{"face_cap":24,"mode":"inscribed"}})", {4, 64, 24, FitMode::inscribed}},
      {R"({"options":{"parts":8}})", {8, 64, 0, FitMode::volume_true}},  // from before there were modes
      {R"({"options":{"face_cap":"x","mode":"odd"}})", {16, 64, 0, FitMode::volume_true}},
      {"no JSON", {32, 64, 0, FitMode::volume_true}},
  };
  {
    ShapeCatalog model(folder / "model.talus", Access::read_write);
    std::vector<LevelOfDetail> levels;
    for (const auto& one : cases) {
      levels.push_back(sample_level(shape, one.key.parts_asked));
      levels.back().provenance.options = one.options;
    }
    model.store_levels(model.store_shape(shape), levels);
  }
  for (const Access access : {Access::read_only, Access::read_write}) {
    fs::remove(folder / "ore.talus");
    make_old_schema(folder / "ore.talus", folder / "model.talus", {"0001_shapes.sql", "0002_views.sql"});
    const ShapeCatalog catalog(folder / "ore.talus", access);
    EXPECT_GE(catalog.schema_version(), 3);
    const ShapeId id = *catalog.find("rock");
    EXPECT_EQ(catalog.summary(id).levels.size(), std::size(cases));
    for (const auto& one : cases) {
      const LevelOfDetail level = catalog.level(id, one.key), made = sample_level(shape, one.key.parts_asked);
      EXPECT_EQ(level.parts.size(), 2u) << one.options;
      EXPECT_EQ(level.provenance.options, one.options);
      EXPECT_EQ(level.error.symmetric_difference, made.error.symmetric_difference);
      EXPECT_EQ(level.error.missing_volume, made.error.missing_volume);
      EXPECT_EQ(level.error.volume_error, made.error.volume_error);
      EXPECT_EQ(level.error.overlap, made.error.overlap);
      EXPECT_EQ(level.error.method_error, made.error.method_error);
      EXPECT_EQ(level.error.surface.mean, made.error.surface.mean);
      EXPECT_EQ(level.error.surface.largest, made.error.surface.largest);
      EXPECT_TRUE(std::isnan(level.error.surface.percentile_95)) << "was not measured";
      EXPECT_TRUE(std::isnan(level.error.convexity_error));
    }
  }
  Sqlite file(folder / "ore.talus");
  EXPECT_EQ(file.value("PRAGMA integrity_check"), "ok");
  EXPECT_EQ(file.value("PRAGMA foreign_key_check"), "");
  EXPECT_EQ(file.value("SELECT count(*) FROM level_overview WHERE mode = 'volume-true'"), "4");
  EXPECT_EQ(file.value("SELECT level_count FROM shape_overview"), "6");
  file.execute("PRAGMA foreign_keys = ON; DELETE FROM shapes");
  EXPECT_EQ(file.value("SELECT count(*) FROM parts"), "0") << "parts go with their shape";
}

TEST(CatalogFile, ShapesOfOlderSchemasAreGradedByTheirChecks) {
  const TemporaryFolder folder;
  {
    ShapeCatalog model(folder / "model.talus", Access::read_write);
    ShapeRecord shape = sample_shape("failed");  // the second volume does not agree
    shape.source_frame = SourceFrame{};
    model.store_shape(shape);
    model.store_shape(sample_shape("sound", 3));
  }
  make_schema_1(folder / "ore.talus", folder / "model.talus");
  for (const Access access : {Access::read_only, Access::read_write}) {
    const ShapeCatalog catalog(folder / "ore.talus", access);
    EXPECT_EQ(catalog.summary(*catalog.find("failed")).grade, 3);
    EXPECT_EQ(catalog.select("grade = 1"), std::vector<ShapeId>{*catalog.find("sound")});
    EXPECT_FALSE(catalog.shape(*catalog.find("failed")).source_frame) << "older files do not tell";
  }
}

TEST(CatalogFile, OldSchemaIsReadWithoutTouchingIt) {
  const TemporaryFolder folder;
  make_catalog(folder / "model.talus", 2);
  make_schema_1(folder / "ore.talus", folder / "model.talus");
  const std::string before = bytes_of(folder / "ore.talus");
  {
    const ShapeCatalog catalog(folder / "ore.talus", Access::read_only);
    EXPECT_GE(catalog.schema_version(), 2);
    EXPECT_EQ(catalog.shape(*catalog.find("rock_1")).mesh.face_count(), 12u);
  }
  EXPECT_TRUE(bytes_of(folder / "ore.talus") == before);
  EXPECT_FALSE(fs::exists(folder / "ore.talus.schema-1"));
}

TEST(CatalogFile, FailedMigrationLeavesTheOldFile) {
  const TemporaryFolder folder;
  make_catalog(folder / "model.talus");
  make_schema_1(folder / "ore.talus", folder / "model.talus");
  Sqlite(folder / "ore.talus").execute("CREATE TABLE level_overview (in_the_way)");
  const std::string before = bytes_of(folder / "ore.talus");
  EXPECT_NE(refusal(folder / "ore.talus", Access::read_write).find("level_overview"), std::string::npos);
  EXPECT_TRUE(bytes_of(folder / "ore.talus") == before);
}

}  // namespace
