// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/skin.h"

#include <gtest/gtest.h>

using dem_gpu::next_skin;
using dem_gpu::Real;

namespace {

constexpr Real kDiameter = 0.01, kListCost = 12;

/// Where the skin ends if bodies use up `per_step` of it in a step.
Real settled_skin(Real per_step, Real skin = 0.1 * kDiameter) {
  for (int list = 0; list < 200; ++list)
    skin = next_skin(skin, static_cast<std::int64_t>(skin / per_step), kDiameter, kListCost);
  return skin;
}

/// Of lists and of tests of candidate pairs, a step.
Real cost(Real skin, Real per_step) { return kListCost * per_step / skin + 3 * skin / kDiameter; }

TEST(Skin, EndsWhereListsAndStepsTogetherCostLeast) {
  for (const Real per_step : {1e-5, 3e-5, 1e-4}) {
    const Real skin = settled_skin(per_step);
    for (const Real other : {0.8, 1.25})
      EXPECT_LT(cost(skin, per_step), cost(other * skin, per_step)) << per_step << " m a step";
  }
}

TEST(Skin, IsTheSameFromWhereverItBegins) {
  const Real skin = settled_skin(2e-5);
  EXPECT_NEAR(settled_skin(2e-5, 0.04 * kDiameter) / skin, 1, 0.05);
  EXPECT_NEAR(settled_skin(2e-5, 0.5 * kDiameter) / skin, 1, 0.05);
}

TEST(Skin, StaysWithinItsLimits) {
  EXPECT_DOUBLE_EQ(settled_skin(1e-12), dem_gpu::kLeastSkin * kDiameter) << "a bed at rest";
  EXPECT_DOUBLE_EQ(settled_skin(1e-3), dem_gpu::kLargestSkin * kDiameter) << "shot through";
  const Real skin = 0.1 * kDiameter;
  EXPECT_DOUBLE_EQ(next_skin(skin, 0, kDiameter, kListCost), 1.25 * skin) << "worn at once";
}

}  // namespace
