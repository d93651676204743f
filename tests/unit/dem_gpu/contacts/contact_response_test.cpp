// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/friction/tangential_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "dem_gpu/contacts/restitution_damping.h"

namespace {

using dem_gpu::damping_ratio;
using dem_gpu::Real;
using dem_gpu::TangentialSpring;
using dem_gpu::Vec3;

/// An elastic law for unit mass and impact speed.
struct ElasticLaw {
  const char* name;
  std::function<Real(Real)> force, energy;  // of the depth
};

ElasticLaw power_law(const char* name, Real n) {
  return {name, [n](Real d) { return std::pow(d, n); }, [n](Real d) { return std::pow(d, n + 1) / (n + 1); }};
}

/// Direct integration of d'' = -(F + c d'), classical Runge-Kutta, until the whole force is zero.
Real rebound_by_integration(const ElasticLaw& law, Real ratio) {
  // A linear dashpot pushes at once at touch; F^2 / (2 U) has a limit there, which a small depth stands for.
  constexpr Real kLeastDepth = 1e-12;
  const auto deceleration = [&](Real depth, Real speed) {
    const Real d = std::max(depth, kLeastDepth), force = law.force(d);
    return force + dem_gpu::dashpot(ratio, 1, force * force / (2 * law.energy(d))) * speed;
  };
  const Real h = 2e-4;
  Real depth = 0, speed = 1;
  for (int i = 0; i < 5000000; ++i) {
    const Real a1 = deceleration(depth, speed), v2 = speed - h / 2 * a1, a2 = deceleration(depth + h / 2 * speed, v2);
    const Real v3 = speed - h / 2 * a2, a3 = deceleration(depth + h / 2 * v2, v3);
    const Real v4 = speed - h * a3, a4 = deceleration(depth + h * v3, v4);
    depth += h / 6 * (speed + 2 * v2 + 2 * v3 + v4);
    speed -= h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    const Real now = deceleration(depth, speed);
    if (speed < 0 && now <= 0) return -speed;
  }
  return -1;
}

TEST(RestitutionDamping, GivesTheRestitutionAskedForUnderAnyElasticLaw) {
  const ElasticLaw laws[] = {
      power_law("flat face", 1),
      power_law("Hertz", 1.5),
      power_law("edge", 2),
      power_law("corner", 3),
      {"hardening", [](Real d) { return d + 2 * d * d; }, [](Real d) { return d * d / 2 + 2 * d * d * d / 3; }}};
  // 1e-3: the start at a depth of zero, where the integration of Hertz and softer laws is of a lower order.
  for (const ElasticLaw& law : laws)
    for (const Real asked : {0.02, 0.1, 0.135335, 0.3, 0.5, 0.8, 0.95, 0.99})
      EXPECT_NEAR(rebound_by_integration(law, damping_ratio(asked)), asked, 1e-3) << law.name;
}

TEST(RestitutionDamping, DampedStiffnessOfPowerLaws) {
  for (const Real n : {1.0, 1.5, 2.0, 3.0}) {
    const Real depth = 0.3, force = std::pow(depth, n), energy = force * depth / (n + 1);
    EXPECT_NEAR(dem_gpu::damped_stiffness(n * force / depth, force / depth), force * force / (2 * energy), 1e-14);
  }
}

TEST(RestitutionDamping, ElasticHasNoneAndTheLeastIsHeld) {
  EXPECT_EQ(damping_ratio(1), 0);
  EXPECT_EQ(damping_ratio(0), damping_ratio(dem_gpu::kLeastRestitution));
  EXPECT_GT(damping_ratio(0), damping_ratio(0.01));
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
