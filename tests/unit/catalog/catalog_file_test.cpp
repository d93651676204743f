// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <random>

#include "tests/support/temporary_folder.h"
#include "tests/unit/catalog/catalog_files.h"

namespace {

using namespace catalog_files;
using test_support::TemporaryFolder;

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

TEST(CatalogFile, ALevelOfAnUnknownModeIsDamage) {
  const TemporaryFolder folder;
  make_catalog(folder / "ore.talus");
  Sqlite(folder / "ore.talus").execute("UPDATE levels SET mode = 'outside'");
  const ShapeCatalog catalog(folder / "ore.talus", Access::read_only);
  EXPECT_THROW(catalog.summary(*catalog.find("rock_0")), InputError);
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
