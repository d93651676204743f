// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog;
using namespace test_support;
namespace fs = std::filesystem;
using Access = ShapeCatalog::Access;

/// SQLite spoken to directly, so that what the catalogue wrote is looked at by another route.
class Sqlite {
 public:
  explicit Sqlite(const fs::path& path) { EXPECT_EQ(sqlite3_open(path.c_str(), &handle_), SQLITE_OK); }
  ~Sqlite() { sqlite3_close(handle_); }
  void execute(const std::string& sql) {
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK) << sql << ": " << error;
    sqlite3_free(error);
  }
  std::string value(const std::string& sql) {
    std::string first;
    const auto keep = [](void* to, int, char** fields, char**) {
      *static_cast<std::string*>(to) = fields[0] ? fields[0] : "";
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), keep, &first, nullptr), SQLITE_OK) << sql;
    return first;
  }

 private:
  sqlite3* handle_ = nullptr;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

void make_catalog(const fs::path& path, int shapes = 1) {
  ShapeCatalog catalog(path, Access::read_write);
  for (int i = 0; i < shapes; ++i) {
    const ShapeRecord shape = sample_shape("rock_" + std::to_string(i), 1 + i);
    catalog.store_levels(catalog.store_shape(shape), {sample_level(shape, 2)});
  }
}

std::string refusal(const fs::path& path, Access access) {
  try {
    ShapeCatalog catalog(path, access);
    for (const ShapeId id : catalog.select("")) {
      catalog.shape(id);
      catalog.level(id, {2, 64});
    }
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find(path.filename().string()), std::string::npos) << text;
    return text;
  }
  return "accepted";
}

void expect_refused(const fs::path& path, const std::string& reason) {
  const std::string before = bytes_of(path);
  for (const Access access : {Access::read_only, Access::read_write})
    EXPECT_NE(refusal(path, access).find(reason), std::string::npos) << refusal(path, access);
  EXPECT_TRUE(bytes_of(path) == before) << "a refused file must not change";
}

/// A file as an older schema wrote it, with the rows of `model`. Levels had fewer columns then.
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
  for (const std::string table : {"shapes", "meshes", "descriptors", "checks", "rejected"})
    old.execute("INSERT INTO main." + table + " SELECT * FROM model." + table);
  old.execute(
      "INSERT INTO main.levels SELECT id, shape_id, parts_asked, vertex_cap, part_count, volume, centroid_x, "
      "centroid_y, centroid_z, principal_inertia_1, principal_inertia_2, principal_inertia_3, mass_properties, "
      "symmetric_difference, missing_volume, volume_error, surface_mean, surface_max, overlap, method_error, "
      "source_file, source_sha256, tool_version, options FROM model.levels");
  old.execute("INSERT INTO main.parts SELECT * FROM model.parts");
}

void make_schema_1(const fs::path& path, const fs::path& model) { make_old_schema(path, model, {"0001_shapes.sql"}); }

/// Runs `body` as a user without write permission to root's files; its result, or -1 if it crashed.
int as_plain_user(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(99);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CatalogFile, HeaderNamesTheApplicationAndTheSchema) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  const std::string bytes = bytes_of(folder / "ore.talus");
  EXPECT_EQ(bytes.substr(68, 4), "Tals");
  const int schema = ShapeCatalog(folder / "ore.talus", Access::read_only).schema_version();
  EXPECT_EQ(schema, bytes[63]);  // user_version, big-endian at offset 60
  EXPECT_GE(schema, 2);
  Sqlite file(folder / "ore.talus");
  EXPECT_EQ(file.value("PRAGMA integrity_check"), "ok");
  EXPECT_EQ(file.value("PRAGMA foreign_key_check"), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "one file, nothing beside it";
}

TEST(CatalogFile, ViewsReadWell) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus", 2);
  Sqlite file(folder / "ore.talus");
  EXPECT_EQ(file.value("SELECT face_count FROM shape_overview WHERE name = 'rock_1'"), "12");
  EXPECT_EQ(file.value("SELECT level_count FROM shape_overview WHERE name = 'rock_1'"), "1");
  EXPECT_EQ(file.value("SELECT part_count FROM level_overview WHERE name = 'rock_1'"), "2");
  EXPECT_EQ(file.value("SELECT sphericity_wadell FROM wide_descriptors WHERE name = 'rock_1'"), "0.5");
  EXPECT_EQ(file.value("SELECT name FROM failed_checks WHERE shape = 'rock_0'"), "volume_second_method");
}

TEST(CatalogFile, WideViewFollowsTheDescriptors) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  ShapeRecord shape = sample_shape("rock");
  catalog.store_shape(shape);
  shape.descriptors["odd \"name's"] = 4;
  shape.descriptors["name"] = 5;
  catalog.store_shape(shape);
  EXPECT_EQ(Sqlite(folder / "ore.talus").value("SELECT \"odd \"\"name's\" FROM wide_descriptors"), "4.0");
}

TEST(CatalogFile, FilesOfAnotherKindAreRefused) {
  const TemporaryFolder folder;
  write_bytes(folder / "text.talus", "this is not a catalogue, it is a longer text\n");
  write_bytes(folder / "short.talus", "x");
  write_bytes(folder / "zeros.talus", std::string(8192, '\0'));
  for (const char* name : {"text.talus", "short.talus", "zeros.talus"})
    expect_refused(folder / name, "is not a Talus catalogue");
  Sqlite(folder / "foreign.talus").execute("CREATE TABLE t (a); PRAGMA application_id = 1196444487");
  Sqlite(folder / "nameless.talus").execute("CREATE TABLE t (a); DROP TABLE t");
  for (const char* name : {"foreign.talus", "nameless.talus"}) expect_refused(folder / name, "of another application");
  EXPECT_NE(refusal(folder.path(), Access::read_write).find("is a folder"), std::string::npos);
}

TEST(CatalogFile, MissingAndEmptyFiles) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "missing.talus", Access::read_only).find("no such file"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "missing.talus"));
  EXPECT_NE(refusal(folder / "no/folder.talus", Access::read_write).find("cannot be opened"), std::string::npos);
  write_bytes(folder / "empty.talus", "");
  EXPECT_NE(refusal(folder / "empty.talus", Access::read_only).find("is empty"), std::string::npos);
  EXPECT_EQ(refusal(folder / "empty.talus", Access::read_write), "accepted");  // what a killed first start leaves
  EXPECT_EQ(refusal(folder / "empty.talus", Access::read_only), "accepted");
}

TEST(CatalogFile, NewerSchemaIsRefused) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  Sqlite(folder / "ore.talus").execute("PRAGMA user_version = 99");
  expect_refused(folder / "ore.talus", "schema 99");
}

TEST(CatalogFile, TruncatedFileIsRefusedWhereverItWasCut) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus", 3);
  const std::string whole = bytes_of(folder / "ore.talus");
  for (std::size_t size : {std::size_t{99}, std::size_t{1000}, std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    write_bytes(folder / "cut.talus", whole.substr(0, size));
    EXPECT_NE(refusal(folder / "cut.talus", Access::read_only), "accepted") << size;
    EXPECT_NE(refusal(folder / "cut.talus", Access::read_write), "accepted") << size;
  }
}

TEST(CatalogFile, DamagedBlobIsFoundByItsHash) {
  const TemporaryFolder folder;
  const fs::path path = folder / "ore.talus";
  for (const char* damage :
       {"UPDATE meshes SET sha256 = replace(sha256, substr(sha256, 1, 4), 'zzzz')", "UPDATE meshes SET faces = x'00'",
        "UPDATE meshes SET vertices = faces", "UPDATE parts SET encoding = substr(encoding, 1, 20)",
        "UPDATE parts SET encoding = (SELECT faces FROM meshes)", "DELETE FROM meshes",
        "UPDATE shapes SET mass_properties = x'0011'"}) {
    fs::remove(path);
    make_catalog(path);
    Sqlite(path).execute(damage);
    EXPECT_NE(refusal(path, Access::read_only).find("is damaged"), std::string::npos) << damage;
  }
}

TEST(CatalogFile, LockedFileIsRefusedAfterAWait) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  Sqlite other(folder / "ore.talus");
  other.execute("BEGIN EXCLUSIVE");
  EXPECT_NE(refusal(folder / "ore.talus", Access::read_only).find("locked by another program"), std::string::npos);
  other.execute("COMMIT");
  EXPECT_EQ(refusal(folder / "ore.talus", Access::read_only), "accepted");
}

TEST(CatalogFile, WriterWaitsForAnotherWriterThenGivesUpWhole) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  Sqlite other(folder / "ore.talus");
  other.execute("BEGIN IMMEDIATE");
  EXPECT_EQ(catalog.select("").size(), 1u);  // readers go on
  EXPECT_THROW(catalog.store_shape(sample_shape("new")), InputError);
  other.execute("ROLLBACK");
  EXPECT_NO_THROW(catalog.store_shape(sample_shape("new")));
}

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

TEST(CatalogFile, ALevelOfAnUnknownModeIsDamage) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  Sqlite(folder / "ore.talus").execute("UPDATE levels SET mode = 'outside'");
  const ShapeCatalog catalog(folder / "ore.talus", Access::read_only);
  EXPECT_THROW(catalog.summary(*catalog.find("rock_0")), InputError);
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

TEST(CatalogFile, ReadOnlyFileInReadOnlyFolder) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  fs::permissions(folder / "ore.talus", fs::perms(0444));
  fs::permissions(folder.path(), fs::perms(0555));
  const auto outcome = [&](Access access) {
    return as_plain_user([&] { return refusal(folder / "ore.talus", access) == "accepted" ? 0 : 3; });
  };
  EXPECT_EQ(outcome(Access::read_only), 0);
  EXPECT_EQ(outcome(Access::read_write), 3);
  fs::permissions(folder.path(), fs::perms(0755));
}

/// Leaves a writer's journal beside the file, whose pages are already half changed.
void interrupt_a_write(const fs::path& path) {
  const pid_t child = fork();
  if (child == 0) {
    Sqlite writer(path);
    writer.execute("PRAGMA cache_size = 1; BEGIN; UPDATE meshes SET vertices = zeroblob(30000)");
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(path.string() + "-journal"));
}

TEST(CatalogFile, ReaderUndoesAnInterruptedWrite) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus", 20);
  interrupt_a_write(folder / "ore.talus");
  const ShapeCatalog catalog(folder / "ore.talus", Access::read_only);
  for (const ShapeId id : catalog.select("")) EXPECT_EQ(catalog.shape(id).mesh.vertex_count(), 8u);
  EXPECT_EQ(catalog.select("").size(), 20u);
}

TEST(CatalogFile, ReaderThatMayNotUndoAnInterruptedWriteSaysSo) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus", 20);
  interrupt_a_write(folder / "ore.talus");
  for (const char* name : {"ore.talus", "ore.talus-journal"}) fs::permissions(folder / name, fs::perms(0444));
  fs::permissions(folder.path(), fs::perms(0555));
  for (const Access access : {Access::read_only, Access::read_write})
    EXPECT_EQ(as_plain_user([&] {
                const std::string text = refusal(folder / "ore.talus", access);
                return text.find("last write was cut off") != std::string::npos ? 0 : 3;
              }),
              0);
  fs::permissions(folder.path(), fs::perms(0755));
  fs::permissions(folder / "ore.talus", fs::perms(0644));
  EXPECT_EQ(refusal(folder / "ore.talus", Access::read_only), "accepted");
}

// Bytes changed anywhere: the catalogue is refused with an InputError or read, but nothing crashes or hangs.
TEST(CatalogFile, FlippedBytesNeverCrash) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus", 3);
  const std::string whole = bytes_of(folder / "ore.talus");
  std::mt19937 random(17);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
      bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    write_bytes(folder / "flipped.talus", bytes);
    refused += refusal(folder / "flipped.talus", Access::read_only) != "accepted";
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
