// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/friction/tangential_spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem_gpu/contacts/restitution_damping.h"

namespace {

using dem_gpu::damping_ratios;
using dem_gpu::impact_restitution;
using dem_gpu::Real;
using dem_gpu::TangentialSpring;
using dem_gpu::Vec3;

TEST(RestitutionDamping, LinearSpringEqualsItsClosedForm) {
  // Force zero, not overlap zero, ends the impact: restitution = exp(-tan(s) (pi - 2 s)), sin(s) = damping ratio
  // (Schwager & Poeschel, Granular Matter 9 (2007) 465-469, rewritten).
  for (const Real ratio : {0.05, 0.2, 0.5, 0.8}) {
    const Real s = std::asin(ratio);
    EXPECT_NEAR(impact_restitution(1, ratio), std::exp(-std::tan(s) * (std::numbers::pi - 2 * s)), 1e-6);
  }
}

TEST(RestitutionDamping, RatiosGiveTheRestitutionAskedFor) {
  for (const Real asked : {0.05, 0.1, 0.3, 0.5, 0.8, 0.95, 0.99}) {
    const auto ratios = damping_ratios(asked);
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(impact_restitution(1 + 0.5 * i, ratios.ratio[i]), asked, 1e-3) << "exponent " << 1 + 0.5 * i;
    for (const Real exponent : {1.2, 1.75, 2.3, 2.8})
      EXPECT_NEAR(impact_restitution(exponent, ratios.at(exponent)), asked, 0.01) << "between table rows";
  }
}

TEST(RestitutionDamping, ElasticHasNone) {
  for (const Real ratio : damping_ratios(1).ratio) EXPECT_EQ(ratio, 0);
  for (const Real exponent : {1.0, 1.5, 2.0, 3.0}) EXPECT_NEAR(impact_restitution(exponent, 0), 1, 1e-4);
}

TEST(RestitutionDamping, TableIsHeldBeyondItsEnds) {
  const auto ratios = damping_ratios(0.5);
  EXPECT_EQ(ratios.at(0.5), ratios.ratio[0]);
  EXPECT_EQ(ratios.at(7), ratios.ratio[4]);
}

const Vec3 kNormal{0, 0, 1};

TEST(TangentialSpring, SticksBelowTheLimit) {
  TangentialSpring spring{{}, 100, 0};
  for (int i = 0; i < 10; ++i) spring.force(kNormal, {0.5, 0, 0}, {0.5, 0, 0}, 1e-3, 10);
  EXPECT_NEAR(spring.displacement.x, 5e-3, 1e-15);
  const Vec3 force = spring.force(kNormal, {}, {}, 1e-3, 10);
  EXPECT_NEAR(force.x, -0.5, 1e-12);
  EXPECT_EQ(force.z, 0);
}

TEST(TangentialSpring, SlidesAtTheLimitAndTurnsBackAtOnce) {
  TangentialSpring spring{{}, 100, 0};
  Vec3 force;
  for (int i = 0; i < 1000; ++i) force = spring.force(kNormal, {1, 1, 0}, {1, 1, 0}, 1e-3, 2);
  EXPECT_NEAR(norm(force), 2, 1e-12);
  EXPECT_NEAR(force.x, force.y, 1e-12);
  EXPECT_NEAR(100 * norm(spring.displacement), 2, 1e-12) << "the spring holds no more than the limit";
  // After 0.02 m backwards the spring is slack.
  for (int i = 0; i < 20; ++i) force = spring.force(kNormal, Vec3{-1, -1, 0} / std::sqrt(2.0), {}, 1e-3, 2);
  EXPECT_LT(norm(force), 1e-10);
}

TEST(TangentialSpring, NeverPullsBeyondTheLimitWithDamping) {
  TangentialSpring spring{{}, 100, 5};
  for (int i = 0; i < 100; ++i) {
    const Vec3 slip{std::sin(0.3 * i), std::cos(0.2 * i), 0};
    EXPECT_LE(norm(spring.force(kNormal, slip, slip, 1e-2, 1)), 1 + 1e-12);
    EXPECT_LE(100 * norm(spring.displacement), 1 + 1e-12);
  }
  EXPECT_EQ(spring.force(kNormal, {1, 0, 0}, {1, 0, 0}, 1e-2, 0), Vec3{});
}

TEST(TangentialSpring, FollowsTheTurningPlane) {
  TangentialSpring spring{{0.01, 0, 0}, 100, 0};
  for (int degree = 1; degree <= 90; ++degree) {
    const Real angle = degree * std::numbers::pi / 180;
    spring.force({std::sin(angle), 0, std::cos(angle)}, {}, {}, 1e-3, 1e9);
  }
  EXPECT_LT(norm(spring.displacement - Vec3{0, 0, -0.01}), 1e-15);
}

}  // namespace
