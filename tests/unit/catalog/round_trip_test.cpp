// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace catalog;
using namespace test_support;
using Access = ShapeCatalog::Access;

// Doubles compared by their bits: -0.0 differs from 0.0, and a NaN equals itself.
std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

template <std::size_t N>
void expect_same_bits(const std::array<double, N>& a, const std::array<double, N>& b) {
  for (std::size_t i = 0; i < N; ++i) EXPECT_EQ(bits(a[i]), bits(b[i])) << a[i] << " and " << b[i];
}

void expect_same(const MassProperties& a, const MassProperties& b) {
  EXPECT_EQ(bits(a.volume), bits(b.volume));
  expect_same_bits(a.centroid, b.centroid);
  expect_same_bits(a.principal_inertia, b.principal_inertia);
  for (int i = 0; i < 3; ++i) expect_same_bits(a.principal_axes[i], b.principal_axes[i]);
}

void expect_same(const Provenance& a, const Provenance& b) {
  EXPECT_EQ(a.source_file, b.source_file);
  EXPECT_EQ(a.source_sha256, b.source_sha256);
  EXPECT_EQ(a.tool_version, b.tool_version);
  EXPECT_EQ(a.options, b.options);
}

void expect_same(const ConvexPart& a, const ConvexPart& b) {
  ASSERT_EQ(a.vertex_count(), b.vertex_count());
  ASSERT_EQ(a.face_count(), b.face_count());
  for (std::size_t v = 0; v < a.vertex_count(); ++v) expect_same_bits(a.vertices[v], b.vertices[v]);
  for (std::size_t f = 0; f < a.face_count(); ++f) {
    EXPECT_EQ(a.faces[f].vertices, b.faces[f].vertices);
    EXPECT_EQ(a.faces[f].kind, b.faces[f].kind);
    expect_same_bits(a.faces[f].plane.normal, b.faces[f].plane.normal);
    EXPECT_EQ(bits(a.faces[f].plane.offset), bits(b.faces[f].plane.offset));
  }
}

/// Values whose last bits a detour by decimal text or by float would lose.
void roughen(std::vector<Point>& vertices, unsigned seed) {
  std::mt19937_64 random(seed);
  for (Point& vertex : vertices)
    for (double& coordinate : vertex) coordinate += 1e-6 * static_cast<double>(random() >> 11) * 0x1p-53;
  vertices[0] = {-0.0, std::numeric_limits<double>::denorm_min(), 1.0 / 3.0};
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(RoundTrip, ShapeComesBackBitForBit) {
  const TemporaryFolder folder;
  ShapeRecord shape = sample_shape("rock 'of' \"Äsch\"; drop table");
  roughen(shape.mesh.vertices, 1);
  shape.mass_properties.centroid = {-0.0, 1e-320, -1.0 / 3};
  shape.source_frame = {{{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}, {1.0 / 3, -0.0, 1e-320}, 1.0 / 7};
  shape.descriptors["infinite"] = std::numeric_limits<double>::infinity();
  shape.descriptors["not_a_number"] = std::numeric_limits<double>::quiet_NaN();
  ShapeId id = 0;
  {
    ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
    id = catalog.store_shape(shape);
  }
  const ShapeCatalog catalog(folder / "ore.talus", Access::read_only);
  ASSERT_EQ(catalog.find(shape.name), id);
  const ShapeRecord back = catalog.shape(id);
  EXPECT_EQ(back.name, shape.name);
  ASSERT_EQ(back.mesh.vertex_count(), shape.mesh.vertex_count());
  for (std::size_t v = 0; v < shape.mesh.vertex_count(); ++v)
    expect_same_bits(back.mesh.vertices[v], shape.mesh.vertices[v]);
  EXPECT_EQ(back.mesh.faces, shape.mesh.faces);
  expect_same(back.mass_properties, shape.mass_properties);
  expect_same(back.provenance, shape.provenance);
  ASSERT_TRUE(back.source_frame);
  for (int i = 0; i < 3; ++i) expect_same_bits(back.source_frame->axes[i], shape.source_frame->axes[i]);
  expect_same_bits(back.source_frame->origin, shape.source_frame->origin);
  EXPECT_EQ(bits(back.source_frame->scale), bits(shape.source_frame->scale));
  ASSERT_EQ(back.descriptors.size(), shape.descriptors.size());
  for (const auto& [name, value] : shape.descriptors) {
    if (std::isnan(value))
      EXPECT_TRUE(std::isnan(back.descriptors.at(name)));
    else
      EXPECT_EQ(bits(back.descriptors.at(name)), bits(value)) << name;
  }
  ASSERT_EQ(back.checks.size(), shape.checks.size());
  for (std::size_t i = 0; i < shape.checks.size(); ++i) {
    EXPECT_EQ(back.checks[i].name, shape.checks[i].name);
    EXPECT_EQ(back.checks[i].passed, shape.checks[i].passed);
    EXPECT_EQ(bits(back.checks[i].figure), bits(shape.checks[i].figure));
    EXPECT_EQ(back.checks[i].detail, shape.checks[i].detail);
  }
}

TEST(RoundTrip, LevelComesBackBitForBit) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeRecord shape = sample_shape("rock");
  const ShapeId id = catalog.store_shape(shape);
  LevelOfDetail level = sample_level(shape, 2);
  roughen(level.parts[0].vertices, 2);
  level.parts[1].faces[3].plane = {{-0.0, 1.0 / 3, 5e-324}, -1.0 / 7};
  catalog.store_levels(id, {level, sample_level(shape, 8)});

  const LevelOfDetail back = catalog.level(id, {2, 64});
  ASSERT_EQ(back.parts.size(), 2u);
  for (int p = 0; p < 2; ++p) expect_same(back.parts[p], level.parts[p]);
  expect_same(back.mass_properties, level.mass_properties);
  expect_same(back.provenance, level.provenance);
  EXPECT_EQ(back.error, level.error);
}

TEST(RoundTrip, LevelsOfOtherModesAndCapsStandBesideOneAnother) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeRecord shape = sample_shape("rock");
  const ShapeId id = catalog.store_shape(shape);
  std::vector<LevelOfDetail> levels;
  double mark = 0;
  for (const FitMode mode : {FitMode::inscribed, FitMode::enclosing, FitMode::volume_true})
    for (const int face_cap : {34, 0})
      for (const int vertex_cap : {64, 16}) {
        levels.push_back(sample_level(shape, 2));
        levels.back().key = {2, vertex_cap, face_cap, mode};
        levels.back().error.symmetric_difference = mark += 1;
      }
  catalog.store_levels(id, levels);
  for (const LevelOfDetail& level : levels) EXPECT_EQ(catalog.level(id, level.key).error, level.error);
  const ShapeSummary summary = catalog.summary(id);
  ASSERT_EQ(summary.levels.size(), levels.size());
  EXPECT_EQ(summary.levels[0].key, (LevelKey{2, 16, 0, FitMode::volume_true})) << "the usual ones first";
  EXPECT_EQ(summary.levels[1].key, (LevelKey{2, 16, 34, FitMode::volume_true}));
  LevelOfDetail again = levels[3];
  again.error.symmetric_difference = 100;
  catalog.store_levels(id, {again});
  EXPECT_EQ(catalog.summary(id).levels.size(), levels.size()) << "the same key takes the same place";
  EXPECT_EQ(catalog.level(id, again.key).error.symmetric_difference, 100);
  try {
    catalog.level(id, {3, 16, 24, FitMode::enclosing});
    FAIL() << "a level that is not there";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("no level of 3 parts of at most 16 vertices and 24 faces, enclosing; kept: 2 parts of at most "
                        "16 vertices; "),
              std::string::npos)
        << text;
  }
}

TEST(RoundTrip, SummaryHoldsLevelsInOrderAndFailedChecks) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeRecord shape = sample_shape("rock");
  const ShapeId id = catalog.store_shape(shape);
  catalog.store_levels(id, {sample_level(shape, 8), sample_level(shape, 1), sample_level(shape, 4)});
  const ShapeSummary summary = catalog.summary(id);
  EXPECT_EQ(summary.name, "rock");
  EXPECT_EQ(summary.volume, shape.mass_properties.volume);
  EXPECT_EQ(summary.face_count, 12u);
  EXPECT_EQ(summary.descriptors, shape.descriptors);
  EXPECT_EQ(summary.failed_checks, std::vector<std::string>{"volume_second_method"});
  ASSERT_EQ(summary.levels.size(), 3u);
  EXPECT_EQ(summary.levels[0].key.parts_asked, 1);
  EXPECT_EQ(summary.levels[1].key.parts_asked, 4);
  EXPECT_EQ(summary.levels[2].key.parts_asked, 8);
  EXPECT_EQ(summary.levels[2].parts, 2);
  EXPECT_EQ(summary.levels[2].error.volume_error, -0.003);
}

TEST(RoundTrip, ReplacingAShapeKeepsItsIdAndDropsItsLevels) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeId other = catalog.store_shape(sample_shape("other"));
  const ShapeRecord first = sample_shape("rock");
  const ShapeId id = catalog.store_shape(first);
  catalog.store_levels(id, {sample_level(first, 2)});
  ShapeRecord second = sample_shape("rock", 3);
  second.descriptors = {{"only_one", 1}};
  EXPECT_EQ(catalog.store_shape(second), id);
  EXPECT_TRUE(catalog.summary(id).levels.empty());
  EXPECT_EQ(catalog.shape(id).descriptors, second.descriptors);
  EXPECT_EQ(catalog.shape(id).mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(catalog.find("other"), other);
  EXPECT_THROW(catalog.level(id, {2, 64}), InputError);
}

TEST(RoundTrip, ARemovedShapeIsGoneWithItsLevelsAndOthersStay) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeRecord shape = sample_shape("rock");
  const ShapeId id = catalog.store_shape(shape), other = catalog.store_shape(sample_shape("other"));
  catalog.store_levels(id, {sample_level(shape, 2)});
  catalog.remove_shape("rock");
  catalog.remove_shape("never there");
  EXPECT_EQ(catalog.select(""), std::vector<ShapeId>{other});
  EXPECT_FALSE(catalog.find("rock"));
  EXPECT_TRUE(catalog.summary(catalog.store_shape(shape)).levels.empty());
}

TEST(RoundTrip, StoringALevelAgainReplacesItAlone) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  const ShapeRecord shape = sample_shape("rock");
  const ShapeId id = catalog.store_shape(shape);
  catalog.store_levels(id, {sample_level(shape, 2), sample_level(shape, 4)});
  LevelOfDetail again = sample_level(shape, 2);
  again.parts.pop_back();
  catalog.store_levels(id, {again});
  EXPECT_EQ(catalog.level(id, {2, 64}).parts.size(), 1u);
  EXPECT_EQ(catalog.level(id, {4, 64}).parts.size(), 2u);
}

TEST(RoundTrip, RejectedInputsAreListedUntilAShapeOfThatNameIsStored) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  catalog.store_rejected({"b", "b.ply", "hash", "open mesh"});
  catalog.store_rejected({"a", "a.ply", "hash", "flat"});
  catalog.store_rejected({"b", "b.ply", "hash 2", "still open"});
  ASSERT_EQ(catalog.rejected().size(), 2u);
  EXPECT_EQ(catalog.rejected()[0].name, "a");
  EXPECT_EQ(catalog.rejected()[1].reason, "still open");
  EXPECT_EQ(catalog.rejected()[1].source_sha256, "hash 2");
  catalog.store_shape(sample_shape("b"));
  ASSERT_EQ(catalog.rejected().size(), 1u);
  EXPECT_EQ(catalog.rejected()[0].source_file, "a.ply");
}

TEST(RoundTrip, SameStoresGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const char* name : {"one.talus", "two.talus"}) {
    ShapeCatalog catalog(folder / name, Access::read_write);
    for (const char* rock : {"a", "b", "c"}) {
      const ShapeRecord shape = sample_shape(rock);
      catalog.store_levels(catalog.store_shape(shape), {sample_level(shape, 2)});
    }
    catalog.store_shape(sample_shape("b", 2));
    catalog.store_rejected({"d", "d.ply", "hash", "flat"});
  }
  EXPECT_TRUE(bytes_of(folder / "one.talus") == bytes_of(folder / "two.talus"));
}

TEST(RoundTrip, ThingsThatDoNotExistAreNamed) {
  const TemporaryFolder folder;
  ShapeCatalog catalog(folder / "ore.talus", Access::read_write);
  EXPECT_EQ(catalog.find("nothing"), std::nullopt);
  EXPECT_THROW(catalog.shape(7), InputError);
  EXPECT_THROW(catalog.summary(7), InputError);
  EXPECT_THROW(catalog.store_levels(7, {}), std::invalid_argument);
  ShapeRecord bad = sample_shape("bad");
  bad.mesh.faces[0][1] = 8;  // vertices are 0 to 7
  EXPECT_THROW(catalog.store_shape(bad), std::invalid_argument);
  EXPECT_THROW(catalog.store_shape(sample_shape("")), std::invalid_argument);
  EXPECT_TRUE(catalog.select("").empty());
}

}  // namespace
