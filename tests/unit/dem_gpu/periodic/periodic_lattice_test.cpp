// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/periodic/periodic_lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "dem_gpu/periodic/ghost_columns.h"

namespace {

using namespace dem_gpu;

TEST(LatticeStep, CodesAreOneToOne) {
  std::set<int> codes;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const int code = code_of({x, y, z});
        codes.insert(code);
        EXPECT_GE(code, 0);
        EXPECT_LT(code, kLatticeSteps);
        const LatticeStep step = lattice_step(code);
        EXPECT_TRUE((step - LatticeStep{x, y, z}).is_none());
      }
  EXPECT_EQ(codes.size(), 27u);
  EXPECT_FALSE((LatticeStep{1, 0, 0} + LatticeStep{1, 0, 0}).is_single());
  EXPECT_TRUE((LatticeStep{1, -1, 1}.is_single()));
}

TEST(PeriodicLattice, PlacesEndInTheBoxWhateverTheRounding) {
  std::mt19937 random(2);
  std::uniform_real_distribution<Real> uniform(-10, 10);
  for (int i = 0; i < 100000; ++i) {
    const Real low = uniform(random), high = low + std::abs(uniform(random)) + Real(1e-3), length = high - low;
    const PeriodicLattice lattice{{low, -HUGE_VAL, low}, {high, HUGE_VAL, high}, {length, 0, length}};
    for (const Real x : {std::nextafter(low, Real(-100)), low, std::nextafter(high, low), high, high + length / 3,
                         std::nextafter(low, Real(100)) - length / 2, low - Real(1e-19)}) {
      const Vec3 inside = lattice.inside({x, Real(123), x});
      ASSERT_GE(inside.x, low);
      ASSERT_LT(inside.x, high);
      ASSERT_EQ(inside.y, 123) << "not periodic along y";
      const LatticeStep step = lattice.step_to({x, 123, x});
      ASSERT_EQ(step.y, 0);
      // As far as it was taken back, up to the rounding of coordinates up to 30 and of the length.
      ASSERT_NEAR(inside.x + lattice.shift(step).x, x, 1e-14);
    }
  }
}

TEST(GhostView, NamesOwnerAndStep) {
  const std::int64_t ids[] = {ghost_id(0, {1, 0, -1}), ghost_id(3, {0, -1, 0}), ghost_id(1 << 28, {1, 1, 1})};
  const GhostView ghosts{ids, 3, 1 << 29};
  EXPECT_FALSE(ghosts.is_ghost(7));
  EXPECT_EQ(ghosts.owner(7), 7);
  EXPECT_TRUE(ghosts.step(7).is_none());
  EXPECT_EQ(ghosts.owner((1 << 29) + 1), 3);
  EXPECT_TRUE((ghosts.step((1 << 29) + 1) - LatticeStep{0, -1, 0}).is_none());
  EXPECT_EQ(ghosts.owner((1 << 29) + 2), 1 << 28);
}

}  // namespace
