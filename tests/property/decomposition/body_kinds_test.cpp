// SPDX-License-Identifier: GPL-3.0-or-later
// Needles, plates, shells, rings and unions of convex solids.
#include <gtest/gtest.h>

#include <cmath>

#include "catalog/input_error.h"
#include "decomposition/convex_decomposition.h"
#include "tests/property/decomposition/random_bodies.h"
#include "tests/support/partition_checks.h"

namespace decomposition {
namespace {

DecompositionOptions quick(int parts) {
  DecompositionOptions options;
  options.parts = parts;
  options.effort = 0.1;
  return options;
}

/// A level that is a partition, volume-true and not far off.
catalog::LevelOfDetail expect_sound_level(const catalog::TriangleMesh& mesh, DecompositionOptions options,
                                          double largest_difference) {
  options.threads = 1;
  catalog::LevelOfDetail level = decompose(mesh, options);
  partition_checks::expect_partition(level);
  EXPECT_NEAR(level.error.volume_error, 0, 3e-4);  // asked for: 1e-3
  EXPECT_LT(level.error.symmetric_difference, largest_difference);
  return level;
}

/// The same on two threads to the last bit.
void expect_sound_level_on_any_threads(const catalog::TriangleMesh& mesh, DecompositionOptions options,
                                       double largest_difference) {
  const catalog::LevelOfDetail level = expect_sound_level(mesh, options, largest_difference);
  options.threads = 2;
  partition_checks::expect_same_bytes(level, decompose(mesh, options));
}

// The symmetric difference is the same in every affine frame: needles and plates fit as well as round bodies.
TEST(BodyKinds, ThinEllipsoidsFitAsWellAsTheBall) {
  const double ball = decompose(solids::sphere(1, 3), quick(1)).error.symmetric_difference;
  for (const catalog::Point& axes :
       {catalog::Point{20, 1, 1}, catalog::Point{50, 1, 1}, catalog::Point{20, 20, 1}, catalog::Point{1, 1000, 30}}) {
    const catalog::TriangleMesh mesh = solids::scaled(solids::sphere(1, 3), axes);
    const double one = expect_sound_level(mesh, quick(1), 1.03 * ball).error.symmetric_difference;
    // Four parts of 32 vertices against one: smooth bodies go by 1 / vertices, less what the cuts take.
    expect_sound_level(mesh, quick(4), 0.5 * one);
  }
}

TEST(BodyKinds, NeedlesAndPlates) {
  const catalog::TriangleMesh rock = random_bodies::random_rock(7, 3);
  for (const catalog::Point& scale :
       {catalog::Point{10, 1, 1}, catalog::Point{10, 10, 0.5}, catalog::Point{50, 1, 1}, catalog::Point{50, 50, 1}}) {
    const catalog::TriangleMesh mesh = solids::scaled(rock, scale);
    const double one = expect_sound_level(mesh, quick(1), 0.048).error.symmetric_difference;
    const double four = expect_sound_level(mesh, quick(4), 0.031).error.symmetric_difference;
    EXPECT_LT(four, one);
  }
  expect_sound_level_on_any_threads(solids::scaled(rock, {50, 1, 1}), quick(2), 0.04);
}

// Stretched up to 300 : 1 along two axes, turned and moved: cuts lie at tiny angles, and no axis is one of the frame's.
TEST(BodyKinds, TurnedRocksOfAnyStretch) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Frame frame = random_frame(random);
    const double second = seed % 3 == 0 ? 300 : std::pow(300, random.uniform());
    catalog::TriangleMesh rock = solids::scaled(random_bodies::random_rock(seed, 3), {300, second, 1});
    for (catalog::Point& p : rock.vertices) p = to_point(frame(to_vec3(p)));
    DecompositionOptions options = quick(1 + static_cast<int>(seed) % 8);
    options.vertex_cap = 24;
    expect_sound_level(solids::moved(rock, {10, -20, 5}), options, 0.09);
  }
}

// The rules on edges and faces hold where the body is as thick as long; the axes of that frame are powers of two.
TEST(BodyKinds, PartsOfNeedlesKeepToTheRulesInTheRoundFrame) {
  const catalog::TriangleMesh needle = solids::scaled(random_bodies::random_rock(7, 3), {64, 1, 1});
  catalog::LevelOfDetail level = decompose(needle, quick(4));
  for (catalog::ConvexPart& part : level.parts)
    for (catalog::Point& p : part.vertices) p[0] /= 64;
  partition_checks::expect_no_slivers(level, 0.01 / 2, 0.02 / 2);  // the frame may be stretched by 2 against this one
}

TEST(BodyKinds, ThinBodiesUnderABound) {
  const catalog::TriangleMesh needle = solids::scaled(random_bodies::random_rock(7, 3), {30, 1, 1});
  DecompositionOptions options = quick(4);
  options.mode = FitMode::enclosing;
  const catalog::LevelOfDetail around = decompose(needle, options);
  partition_checks::expect_partition(around);
  EXPECT_LT(around.error.symmetric_difference, 0.08);
  for (const catalog::Point& p : needle.vertices) EXPECT_TRUE(partition_checks::holds(around, p));
  options.mode = FitMode::inscribed;
  const catalog::LevelOfDetail within = decompose(needle, options);
  partition_checks::expect_partition(within);
  EXPECT_LT(within.error.symmetric_difference, 0.12);
  EXPECT_LT(within.error.symmetric_difference - within.error.missing_volume, 1e-3) << "stands out";
}

// More parts under a bound are never worse, at the least effort too.
TEST(BodyKinds, BoundedLevelsAreALadder) {
  for (const FitMode mode : {FitMode::enclosing, FitMode::inscribed}) {
    DecompositionOptions options = quick(1);
    options.mode = mode;
    double previous = 1;
    for (const catalog::LevelOfDetail& level : decompose_ladder(random_bodies::random_rock(2), {1, 2, 4}, options)) {
      EXPECT_LE(std::abs(level.error.volume_error), previous);
      previous = std::abs(level.error.volume_error);
    }
  }
}

// The hulls of a drawn solid's pieces: nothing is nearer to it and holds it.
TEST(BodyKinds, EnclosedDrawnSolidsAreHeldByTheirPiecesHulls) {
  DecompositionOptions options = quick(8);
  options.mode = FitMode::enclosing;
  options.smallest_thickness = 0.01;
  const catalog::LevelOfDetail bowl = decompose(random_bodies::bowl(0.1), options);
  partition_checks::expect_partition(bowl);
  EXPECT_NEAR(bowl.error.volume_error, 0, 1e-9);  // five boxes
  Random random(3);
  const Frame frame = random_frame(random);
  catalog::TriangleMesh turned = solids::scaled(solids::l_shape(), {20, 20, 1});
  for (catalog::Point& p : turned.vertices) p = to_point(frame(to_vec3(p)));
  const catalog::LevelOfDetail level = decompose(turned, options);
  partition_checks::expect_partition(level);
  EXPECT_EQ(level.parts.size(), 2u);
  EXPECT_NEAR(level.error.volume_error, 0, 1e-9);
}

// One convex part cannot stand for a thin shell.
TEST(BodyKinds, PartsThatMissTheMeshAreRefused) {
  try {
    decompose(random_bodies::random_shell(3, 0.02), quick(1));
    FAIL();
  } catch (const catalog::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("so few parts cannot stand for it; ask for more parts"), std::string::npos)
        << error.what();
  }
}

// Bounds below: what the least effort reaches, with a margin of a tenth or two; a cut made elsewhere takes more.
TEST(BodyKinds, ShellsWithACavity) {
  for (const double wall : {0.4, 0.1}) {
    DecompositionOptions options = quick(8);
    options.smallest_thickness = 0.01;  // the walls are thinner than a tenth of the whole
    const catalog::LevelOfDetail level =
        expect_sound_level(random_bodies::random_shell(3, wall), options, wall > 0.2 ? 0.13 : 0.8);
    EXPECT_NE(level.provenance.options.find("\"cavities\":1"), std::string::npos);
  }
}

TEST(BodyKinds, BowlsOfThinWalls) {
  DecompositionOptions options = quick(6);
  options.smallest_thickness = 0.01;
  expect_sound_level_on_any_threads(random_bodies::bowl(0.2), options, 1e-6);  // five boxes, found exactly
  expect_sound_level(random_bodies::bowl(0.05), options, 0.006);
}

TEST(BodyKinds, RingsOfOneAndTwoHoles) {
  expect_sound_level_on_any_threads(solids::torus(1, 0.4, 24, 12), quick(8), 0.037);
  expect_sound_level(
      solids::voxels(5, [](int i, int j, int k) { return k == 0 && j < 3 && !(j == 1 && (i == 1 || i == 3)); }),
      quick(8), 0.001);
}

TEST(BodyKinds, ConvexSolidsApartAreOneBody) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) expect_sound_level(random_bodies::random_row(seed), quick(4), 0.08);
}

// All columns of a block of exact coordinates are equally long: points spread along them must not lie in one plane.
TEST(BodyKinds, BlockWithANarrowSlit) {
  catalog::TriangleMesh slit =
      solids::voxels(3, [](int i, int j, int k) { return j == 0 && k < 2 && !(i == 1 && k == 1); });
  constexpr double kAlong[] = {0, 1, 1.001, 2};
  for (catalog::Point& p : slit.vertices) p = {kAlong[static_cast<int>(p[0])], p[1], p[2] / 2};
  for (const int parts : {1, 2}) {
    const catalog::LevelOfDetail level = decompose(slit, quick(parts));
    partition_checks::expect_partition(level);
    EXPECT_LT(level.error.symmetric_difference, 0.005);
  }
}

}  // namespace
}  // namespace decomposition
