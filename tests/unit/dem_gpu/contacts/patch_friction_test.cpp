// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/friction/patch_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "dem_gpu/narrow_phase/patch_sums.h"
#include "tests/support/dem_scenes.h"

namespace {

using namespace test_support;
using dem_gpu::ContactPatch;
using dem_gpu::Mat3;
using dem_gpu::PatchFriction;
using dem_gpu::PatchSprings;

/// One contact of a 20 mm body at 1 kN load on its own columns; stiffness 4e5 N/m.
struct OneContact {
  dem_gpu::ContactRow row;
  Vec3 spin, normal;
  dem_gpu::ElasticContact elastic;
  dem_gpu::PairProperties pair;
  ContactPatch patch;
  dem_gpu::FrictionForces friction;
  Real energy_before = 0;

  explicit OneContact(Real restitution) {
    pair = {dem_gpu::damping_ratio(restitution), 0.5, 0};
    elastic.normal = {0, 0, 1};
    set({{0, 0, 1}}, 1000, 0.008);
  }
  /// Flat patches of equal load with these normals.
  void set(const std::vector<Vec3>& normals, Real load, Real lever) {
    patch.normals = Mat3{{}, {}, {}};
    for (const Vec3& n : normals) add_outer_product(patch.normals, Real(1) / normals.size(), n);
    patch.load = load;
    patch.lever = lever;
    patch.stiffness_per_area = 1e9;
    elastic.force = -load * elastic.normal;
  }
  static constexpr Real kStiffness = 1e9 * 0.02 * 0.02;

  void step(const Vec3& velocity, const Vec3& angular_velocity, Real time_step) {
    dem_gpu::ContactView view{};
    view.tangential_displacement = {&row};
    view.turning_displacement = &spin;
    view.spring_normal = &normal;
    dem_gpu::FrictionContact contact{elastic, pair, 0, 0.02, 0.02, time_step, 1};
    contact.mean = contact.predicted = {velocity, angular_velocity};
    energy_before = friction.energy;
    friction = PatchFriction{1}.apply(view, 0, contact, patch);
  }
  Real limit_share() const {
    const Real force = norm(friction.force) / (0.5 * patch.load);
    const Real couple = norm(friction.couple) / (PatchFriction::kSpinShare * 0.5 * patch.load * patch.lever);
    return std::sqrt(force * force + couple * couple);
  }
};

TEST(PatchFriction, SticksAsSpringsBelowTheLimit) {
  OneContact contact(1);
  for (int i = 0; i < 10; ++i) contact.step({0.01, 0.02, 5}, {3, 4, 1}, 1e-3);
  EXPECT_NEAR(contact.friction.force.x, -OneContact::kStiffness * 1e-4, 1e-9);
  EXPECT_EQ(contact.friction.force.z, 0) << "no slip along the normal";
  EXPECT_NEAR(contact.friction.couple.z, -OneContact::kStiffness * 0.008 * 0.008 * 0.01, 1e-9);
  EXPECT_EQ(contact.friction.couple.x, 0) << "no spin but about the normal";
}

TEST(PatchFriction, StaysWithinOneLimit) {
  std::mt19937 random(3);
  for (const Real restitution : {0.2, 0.5, 1.0}) {
    OneContact contact(restitution);
    for (int i = 0; i < 1000; ++i) {
      contact.set({random_direction(random), random_direction(random)}, 10 + i % 7 * 100, 0.002 + i % 5 * 0.002);
      contact.step(random_direction(random), 100 * random_direction(random), 1e-4);
      EXPECT_LE(contact.limit_share(), 1 + 1e-12);
    }
  }
}

TEST(PatchFriction, FullForceOrFullCoupleAtTheLimit) {
  OneContact sliding(0.5), spinning(0.5);
  for (int i = 0; i < 1000; ++i) sliding.step({1, 0, 0}, {}, 1e-4), spinning.step({}, {0, 0, 100}, 1e-4);
  EXPECT_NEAR(sliding.friction.force.x, -500, 1e-9);
  EXPECT_NEAR(spinning.friction.couple.z, -500 * PatchFriction::kSpinShare * 0.008, 1e-9);
}

TEST(PatchFriction, InnerCornerHoldsFullyAlongAndHalfAcross) {
  OneContact along(0.5), across(0.5);
  for (OneContact* contact : {&along, &across}) contact->set({{1, 0, 0}, {0, 0, 1}}, 1000, 0.008);
  for (int i = 0; i < 2000; ++i) along.step({0, 1, 0}, {}, 1e-4), across.step({1, 0, 0}, {}, 1e-4);
  EXPECT_NEAR(along.friction.force.y, -500, 1e-9);
  EXPECT_NEAR(across.friction.force.x, -250, 1e-9);
}

TEST(PatchFriction, ChangesOfLoadAndPatchAddNoEnergy) {
  // At rest, whatever load and patch do.
  std::mt19937 random(4);
  OneContact contact(1);
  contact.step({0.5, 0.2, 0}, {0, 0, 30}, 1e-3);
  for (int i = 0; i < 1000; ++i) {
    contact.elastic.normal = unit_or(contact.elastic.normal + 0.2 * random_direction(random), {0, 0, 1});
    contact.set({contact.elastic.normal, random_direction(random)}, 900 + 10 * (i % 20), 0.001 * (1 + i % 9));
    contact.step({}, {}, 1e-3);
    ASSERT_LE(contact.friction.energy, contact.energy_before * (1 + 1e-12));
  }
  EXPECT_GT(contact.friction.energy, 0);
}

TEST(PatchFriction, LoadUpAndDownLeavesAStuckContactWhereItWas) {
  OneContact contact(1);
  contact.step({0.05, 0, 0}, {0, 0, 2}, 1e-3);
  const Vec3 force = contact.friction.force, couple = contact.friction.couple;
  for (const Real load : {800., 300., 150., 400., 1000.}) {
    contact.set({{0, 0, 1}}, load, 0.008);
    contact.step({}, {}, 1e-3);
  }
  EXPECT_EQ(contact.friction.force, force);
  EXPECT_EQ(contact.friction.couple, couple);
}

TEST(PatchSprings, FollowTheTurningPlaneAndTheSpin) {
  PatchSprings<dem_gpu::Real> springs{{0.01, 0, 0}, {0, 0, 0.01}};
  Vec3 last{0, 0, 1};
  for (int degree = 1; degree <= 90; ++degree) {
    const Real angle = degree * std::numbers::pi / 180;
    const Vec3 normal{std::sin(angle), 0, std::cos(angle)};
    springs.turn(last, normal, 0);
    last = normal;
  }
  EXPECT_LT(norm(springs.slip - Vec3{0, 0, -0.01}), 1e-15);
  EXPECT_LT(norm(springs.spin - Vec3{0.01, 0, 0}), 1e-15);
  for (int i = 0; i < 1000; ++i) springs.turn(last, last, std::numbers::pi / 2000);
  // Half a turn's tangent by its angle: third order.
  EXPECT_LT(norm(springs.slip - Vec3{0, 0.01, 0}), 1e-8);
  EXPECT_NEAR(norm(springs.slip), 0.01, 1e-15);
  springs.turn(last, -last, 0);
  EXPECT_NEAR(springs.slip.y, 0.01, 1e-8) << "a normal that jumps turns nothing";
}

}  // namespace
