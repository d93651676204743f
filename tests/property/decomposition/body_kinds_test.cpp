// SPDX-License-Identifier: GPL-3.0-or-later
// Needles, plates, shells, rings and unions of convex solids.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

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

/// A level that is a partition, volume-true and not far off, the same on one and two threads.
catalog::LevelOfDetail expect_sound_level(const catalog::TriangleMesh& mesh, DecompositionOptions options,
                                          double largest_difference) {
  options.threads = 1;
  catalog::LevelOfDetail level = decompose(mesh, options);
  partition_checks::expect_partition(level);
  EXPECT_NEAR(level.error.volume_error, 0, 1e-3);
  EXPECT_LT(level.error.symmetric_difference, largest_difference);
  options.threads = 2;
  partition_checks::expect_same_bytes(level, decompose(mesh, options));
  return level;
}

TEST(BodyKinds, NeedlesAndPlates) {
  const catalog::TriangleMesh rock = random_bodies::random_rock(7, 3);
  for (const catalog::Point& scale : {catalog::Point{10, 1, 1}, catalog::Point{10, 10, 0.5}})
    expect_sound_level(solids::scaled(rock, scale), quick(4), 0.2);
  // The fit steps by shares of the diagonal: beyond 20 : 1 the parts are volume-true still, but fit poorly.
  for (const catalog::Point& scale : {catalog::Point{50, 1, 1}, catalog::Point{50, 50, 1}})
    expect_sound_level(solids::scaled(rock, scale), quick(4), 1);
}

// Thinner than the fit can follow: what is given out stands for the body, the rest is refused.
TEST(BodyKinds, ThinBodiesAreFittedOrRefused) {
  const catalog::TriangleMesh needle = solids::scaled(solids::sphere(1, 3), {50, 1, 1});
  int refused = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    DecompositionOptions options = quick(8);
    options.seed = seed;
    try {
      const catalog::LevelOfDetail level = decompose(needle, options);
      EXPECT_LT(level.error.symmetric_difference, 1) << seed;
      EXPECT_LT(std::abs(level.error.volume_error), 0.05) << seed;
    } catch (const catalog::InputError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("it is too thin for the fit; ask for another number of parts"),
                std::string::npos)
          << error.what();
    }
  }
  std::printf("  %d of 4 refused\n", refused);
}

TEST(BodyKinds, ShellsWithACavity) {
  for (const double wall : {0.4, 0.1}) {
    const catalog::LevelOfDetail level =
        expect_sound_level(random_bodies::random_shell(3, wall), quick(8), wall > 0.2 ? 0.35 : 1.0);
    EXPECT_NE(level.provenance.options.find("\"cavities\":1"), std::string::npos);
  }
}

TEST(BodyKinds, BowlsOfThinWalls) {
  for (const double wall : {0.2, 0.05}) {
    DecompositionOptions options = quick(6);
    options.smallest_thickness = 0.01;  // the walls are thinner than a tenth of the whole
    expect_sound_level(random_bodies::bowl(wall), options, 0.5);
  }
}

TEST(BodyKinds, RingsOfOneAndTwoHoles) {
  expect_sound_level(solids::torus(1, 0.4, 24, 12), quick(8), 0.3);
  expect_sound_level(
      solids::voxels(5, [](int i, int j, int k) { return k == 0 && j < 3 && !(j == 1 && (i == 1 || i == 3)); }),
      quick(8), 0.3);
}

TEST(BodyKinds, ConvexSolidsApartAreOneBody) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) expect_sound_level(random_bodies::random_row(seed), quick(4), 0.5);
}

}  // namespace
}  // namespace decomposition
