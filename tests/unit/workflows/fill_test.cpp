// SPDX-License-Identifier: Apache-2.0
#include "workflows/fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "workflows/random_stream.h"

namespace workflows {
namespace {

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

std::vector<double> random_radii(int count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) radii.push_back(0.01 + 0.01 * random.uniform());
  return radii;
}

const Point kUp{0, 0, 1};
const CylinderRegion kUpright{{0.1, -0.2, 0.3}, kUp, 0.2, 0.6};
const CylinderRegion kLying{{0, -0.1, 0}, {0, 1, 0}, 0.3, 0.2};
const CylinderRegion kLeaning{{0, 0, 0}, {0.6, 0, 0.8}, 0.2, 0.5};
const BoxRegion kBox{{-0.2, -0.15, 0}, {0.2, 0.15, 0.5}};

TEST(Fill, BallsNeitherOverlapNorLeaveTheRegion) {
  const std::vector<FillRegion> regions{kUpright, kLying, kLeaning, kBox};
  std::uint64_t seed = 1;
  for (const FillRegion& region : regions)
    for (const Lattice lattice : {Lattice::hexagonal, Lattice::cubic}) {
      const std::vector<double> radii = random_radii(120, ++seed);
      const FillLayout layout{lattice, 0.01, 1, seed};
      const std::vector<Placement> placements = fill_region(region, radii, layout, kUp, "fill");
      ASSERT_EQ(placements.size(), radii.size());
      for (std::size_t i = 0; i < radii.size(); ++i) {
        EXPECT_TRUE(contains_ball(region, placements[i].position, radii[i]));
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GE(distance(placements[i].position, placements[j].position), radii[i] + radii[j]);
      }
    }
}

TEST(Fill, HexagonalLatticeReachesTheDensestPacking) {
  // Share of space pi / sqrt(18); at each side of the region less than a layer is lost.
  const double spacing = 0.01, edge = 0.4;
  const BoxRegion region{{0, 0, 0}, {edge, edge, edge}};
  const double cells = double(lattice_cells(region, Lattice::hexagonal, spacing, kUp).size());
  const double share = cells * std::numbers::pi / 6 * std::pow(spacing, 3) / volume(region);
  EXPECT_LT(share, std::numbers::pi / std::sqrt(18.0));
  EXPECT_GT(share, std::numbers::pi / std::sqrt(18.0) * std::pow(1 - 2 * spacing / edge, 3));
}

TEST(Fill, CellsTouchTheirNearestNeighbours) {
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::cubic}) {
    const std::vector<Point> cells = lattice_cells(kBox, lattice, 0.05, kUp);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double nearest = 1;
      for (std::size_t j = 0; j < cells.size(); ++j)
        if (j != i) nearest = std::min(nearest, distance(cells[i], cells[j]));
      EXPECT_NEAR(nearest, 0.05, 1e-9);
    }
  }
}

TEST(Fill, FillsFromBelow) {
  const std::vector<Placement> placements = fill_region(kUpright, random_radii(30, 5), {}, kUp, "fill");
  for (const Placement& placement : placements) EXPECT_LT(placement.position[2], 0.3 + 0.1);
}

TEST(Fill, SameSeedSamePlacesOtherSeedOthers) {
  const std::vector<double> radii = random_radii(40, 2);
  FillLayout layout;
  const auto first = fill_region(kBox, radii, layout, kUp, "fill"),
             again = fill_region(kBox, radii, layout, kUp, "fill");
  layout.seed = 2;
  const auto other = fill_region(kBox, radii, layout, kUp, "fill");
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_EQ(first[i].position, again[i].position);
    EXPECT_EQ(first[i].orientation, again[i].orientation);
    EXPECT_NE(first[i].position, other[i].position);
  }
}

TEST(Fill, RefusesWhatDoesNotFitWithTheNumberThatDoes) {
  const std::size_t fits = lattice_cells(kBox, Lattice::hexagonal, 2 * 0.05 * 1.02, kUp).size();
  try {
    fill_region(kBox, std::vector<double>(500, 0.05), {}, kUp, "scene.toml:9:1: fill \"ore\"");
    FAIL() << "not refused";
  } catch (const catalog::InputError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("scene.toml:9:1: fill \"ore\": the region holds " + std::to_string(fits) + " of the 500 bodies"),
        std::string::npos)
        << error.what();
  }
  EXPECT_THROW(fill_region(kBox, {1e-6}, {}, kUp, "fill"), catalog::InputError);  // micrometres in a box of metres
}

TEST(RandomStream, RotationsAreUniform) {
  // Of uniform rotations, the image of a fixed direction has mean 0 and mean square 1/3 along each axis.
  RandomStream random(7);
  constexpr int count = 20000;
  double mean = 0, mean_square = 0;
  for (int i = 0; i < count; ++i) {
    const auto [w, x, y, z] = random.rotation();
    EXPECT_NEAR(w * w + x * x + y * y + z * z, 1, 1e-14);
    const double image = 1 - 2 * (x * x + y * y);  // z of the rotated z axis
    mean += image / count;
    mean_square += image * image / count;
  }
  // Standard errors: sqrt(1/3 / n) and sqrt(4/45 / n); five of them.
  EXPECT_NEAR(mean, 0, 5 * std::sqrt(1.0 / 3 / count));
  EXPECT_NEAR(mean_square, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / count));
}

TEST(RandomStream, IsSplitMix64) {
  // First output of the reference implementation for state 0, https://prng.di.unimi.it/splitmix64.c, is
  // 0xe220a8397b1dcdaf; seeding draws it as the state of stream 0.
  RandomStream seeded(0);
  std::uint64_t z = 0xe220a8397b1dcdafULL + 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  EXPECT_EQ(seeded.next(), z ^ (z >> 31));
}

}  // namespace
}  // namespace workflows
