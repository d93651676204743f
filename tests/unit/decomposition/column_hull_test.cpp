// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/column_hull.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/solids.h"

namespace decomposition {
namespace {

TEST(ColumnHull, VolumeOfACutTorusIsNearThatOfItsHull) {
  const Solid solid(solids::torus(1, 0.4, 48, 24), 2.5e5);
  // Hull of a torus of radii R and r: 2 pi r R^2 + pi^2 r^2 R + 4/3 pi r^3 (Steiner, of a disc of radius R).
  const double whole = std::numbers::pi * (2 * 0.4 + std::numbers::pi * 0.16 + 4.0 / 3 * 0.064);
  const PartFit hull = column_hull(solid.stretches_inside({}), 26, 2);
  EXPECT_NEAR(hull.volume / whole, 1, 0.03);  // 128 support points, and 48 x 24 faces for the torus
  // A plane through the axis halves it.
  const PartFit half = column_hull(clipped(solid.stretches_inside({}), {{0.6, 0.8, 0}, 0}), 26, 2);
  EXPECT_NEAR(half.volume / whole, 0.5, 0.02);
}

TEST(ColumnHull, NothingOfNothing) { EXPECT_FALSE(column_hull({}, 26, 2).is_valid()); }

}  // namespace
}  // namespace decomposition
