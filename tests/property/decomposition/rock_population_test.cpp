// SPDX-License-Identifier: GPL-3.0-or-later
// 200 random rocks at the least effort: what every level promises, whatever the options.
#include <gtest/gtest.h>

#include "catalog/mass_properties.h"
#include "decomposition/convex_decomposition.h"
#include "tests/property/decomposition/random_bodies.h"
#include "tests/support/partition_checks.h"

namespace decomposition {
namespace {

constexpr int kRocks = 200, kGroups = 8;
constexpr double kWidthSampling = 0.97;  // the search and this test sample the rock's width in other directions

/// Caps and parts that change from rock to rock.
DecompositionOptions options_of(int rock) {
  DecompositionOptions options;
  options.parts = 1 + rock % 4;
  options.vertex_cap = 8 + 8 * (rock % 8);
  options.face_cap = rock % 3 == 0 ? 8 + rock % 40 : 0;
  options.seed = static_cast<std::uint64_t>(rock);
  options.effort = 0.1;
  options.threads = 1;
  return options;
}

void expect_caps(const catalog::LevelOfDetail& level, const DecompositionOptions& options,
                 const catalog::TriangleMesh& rock) {
  EXPECT_LE(level.parts.size(), static_cast<std::size_t>(options.parts));
  const double volume = catalog::volume_moments(rock).volume, width = random_bodies::width(rock);
  for (const catalog::ConvexPart& part : level.parts) {
    EXPECT_LE(part.vertex_count(), static_cast<std::size_t>(options.vertex_cap));
    EXPECT_TRUE(options.face_cap == 0 || part.face_count() <= static_cast<std::size_t>(options.face_cap));
    EXPECT_GE(partition_checks::volume(part), options.smallest_volume * volume);
    EXPECT_GE(partition_checks::thickness(part), kWidthSampling * options.smallest_thickness * width);
  }
}

class RockPopulation : public ::testing::TestWithParam<int> {};

TEST_P(RockPopulation, KeepsEveryPromise) {
  for (int rock = GetParam(); rock < kRocks; rock += kGroups) {
    SCOPED_TRACE("rock " + std::to_string(rock));
    const catalog::TriangleMesh mesh = random_bodies::random_rock(static_cast<std::uint64_t>(1000 + rock), 3);
    DecompositionOptions options = options_of(rock);
    const catalog::LevelOfDetail level = decompose(mesh, options);
    partition_checks::expect_partition(level);
    expect_caps(level, options, mesh);
    EXPECT_NEAR(level.error.volume_error, 0, 1e-3) << "the body neither shrinks nor grows";
    EXPECT_NEAR(level.error.overlap, 0, 1e-9) << "rounding of the rays";
    if (rock % 20 != 0) continue;
    options.threads = 2;
    partition_checks::expect_same_bytes(level, decompose(mesh, options));
  }
}

INSTANTIATE_TEST_SUITE_P(Groups, RockPopulation, ::testing::Range(0, kGroups));

}  // namespace
}  // namespace decomposition
