// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>

#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog;
using namespace test_support;

constexpr int kRounds = 40;

/// Stores shapes for ever; every figure of one store carries the same generation. Writes a byte to `started` after
/// each.
[[noreturn]] void write_until_killed(const std::filesystem::path& path, int first_generation, int started) {
  ShapeCatalog catalog(path, ShapeCatalog::Access::read_write);
  for (int generation = first_generation;; ++generation) {
    ShapeRecord shape = sample_shape("rock_" + std::to_string(generation % 5));
    shape.mesh.vertices[0][0] = generation;
    shape.descriptors = {{"generation", generation}};
    shape.provenance.options = std::to_string(generation);
    const ShapeId id = catalog.store_shape(shape);
    LevelOfDetail level = sample_level(shape, 2);
    level.error.overlap = generation;
    for (ConvexPart& part : level.parts) part.vertices[0][0] = generation;
    catalog.store_levels(id, {level});
    if (write(started, "x", 1) != 1) _exit(1);
  }
}

void expect_whole(const ShapeCatalog& catalog) {
  for (const ShapeId id : catalog.select("")) {
    const ShapeRecord shape = catalog.shape(id);
    const double generation = shape.descriptors.at("generation");
    EXPECT_EQ(shape.mesh.vertices[0][0], generation);
    EXPECT_EQ(shape.provenance.options, std::to_string(static_cast<int>(generation)));
    EXPECT_EQ(shape.checks.size(), 2u);
    if (catalog.summary(id).levels.empty()) continue;  // killed between its two stores
    const LevelOfDetail level = catalog.level(id, {2, 64});
    EXPECT_EQ(level.error.overlap, generation);
    ASSERT_EQ(level.parts.size(), 2u);
    for (const ConvexPart& part : level.parts) EXPECT_EQ(part.vertices[0][0], generation);
  }
}

std::string integrity(const std::filesystem::path& path) {
  sqlite3* handle = nullptr;
  sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READONLY, nullptr);
  std::string answer;
  const auto keep = [](void* to, int, char** fields, char**) {
    *static_cast<std::string*>(to) += fields[0];
    return 0;
  };
  sqlite3_exec(handle, "PRAGMA integrity_check", keep, &answer, nullptr);
  sqlite3_close(handle);
  return answer;
}

TEST(KilledWriter, LeavesTheCatalogueWhole) {
  const TemporaryFolder folder;
  std::mt19937 random(7);
  for (int round = 0; round < kRounds; ++round) {
    int started[2];
    ASSERT_EQ(pipe(started), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_until_killed(folder / "ore.talus", 1000 * round + round, started[1]);
    close(started[1]);
    // Even rounds may fall into the making or opening of the file, odd ones into the stores that follow.
    char byte = 0;
    if (round % 2 == 1) {
      ASSERT_EQ(read(started[0], &byte, 1), 1) << "the writer stopped by itself";
    }
    usleep(random() % 20000);  // [us]
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(started[0]);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer stopped by itself";
    if (!std::filesystem::exists(folder / "ore.talus")) continue;  // killed before its first byte
    const ShapeCatalog catalog(folder / "ore.talus", ShapeCatalog::Access::read_write);
    expect_whole(catalog);
    ASSERT_EQ(integrity(folder / "ore.talus"), "ok");
  }
  // The generations of the odd rounds alone reach every name.
  EXPECT_EQ(ShapeCatalog(folder / "ore.talus", ShapeCatalog::Access::read_only).select("").size(), 5u);
}

}  // namespace
