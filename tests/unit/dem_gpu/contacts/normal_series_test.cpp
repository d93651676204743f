// SPDX-License-Identifier: Apache-2.0
// The power series of a sphere contact's motion over a step against the same motion in many sub-steps.
#include <gtest/gtest.h>

#include <random>

#include "dem_gpu/contacts/laws/adhesive.h"
#include "dem_gpu/contacts/laws/hertz.h"
#include "dem_gpu/contacts/laws/linear_spring.h"
#include "dem_gpu/contacts/normal_orbit.h"
#include "dem_gpu/contacts/normal_series.h"

namespace {

using namespace dem_gpu;

template <class Law>
struct Drawn {
  NormalStart<Real> start;
  Real step = 1;
};

/// Contacts from at rest to changing by half their depth in a step of a twentieth of their contact time and more.
template <class Law>
Drawn<Law> drawn(std::mt19937& random) {
  std::uniform_real_distribution<Real> share(0, 1);
  const Real rate = 0.05 + 0.4 * share(random), depth = 0.1 + share(random);
  Drawn<Law> contact;
  contact.start.depth = depth;
  contact.start.per_depth = 1 / depth;
  contact.start.elastic = rate * rate * depth / Law::kExponent;
  contact.start.damping = 2 * rate * share(random);
  contact.start.adhesion = Law::kIsAdhesive ? 0.2 * contact.start.elastic * share(random) : 0;
  contact.start.speed = depth * rate * (2 * share(random) - 1);
  contact.start.acceleration = 2 * contact.start.elastic * (2 * share(random) - 1);
  return contact;
}

template <class Law>
NormalKick<Real> in_substeps(const Drawn<Law>& contact) {
  constexpr int kSubsteps = 2000;
  const NormalStart<Real>& start = contact.start;
  NormalOrbit orbit{{start.per_depth, start.elastic, start.damping, start.adhesion, Law::kExponent > 1},
                    start.depth,
                    start.speed,
                    start.acceleration};
  orbit.advance(contact.step, kSubsteps, false);
  return {orbit.kick, orbit.shift / contact.step};
}

template <class Law>
class NormalSeriesTest : public testing::Test {};
using Laws = testing::Types<LinearSpring, Hertz, Adhesive<LinearSpring>, Adhesive<Hertz>>;
TYPED_TEST_SUITE(NormalSeriesTest, Laws);

TYPED_TEST(NormalSeriesTest, IsTheOrbitWhereItSaysSo) {
  std::mt19937 random(5);
  int good = 0;
  for (int i = 0; i < 2000; ++i) {
    const Drawn<TypeParam> contact = drawn<TypeParam>(random);
    NormalSeries<TypeParam, Real> series;
    const NormalKick<Real> found = series.advance(contact.start, contact.step);
    if (!series.is_good()) continue;
    ++good;
    const NormalKick<Real> expected = in_substeps(contact);
    const Real tolerance = NormalSeries<TypeParam, Real>::kSeriesTolerance * contact.start.elastic * contact.step;
    EXPECT_NEAR(found.kick, expected.kick, tolerance);
    EXPECT_NEAR(found.mean, expected.mean, tolerance);
  }
  EXPECT_GT(good, 500);
}

TYPED_TEST(NormalSeriesTest, IsNotTakenForAContactThatLetsGoInTheStep) {
  std::mt19937 random(6);
  int parted = 0;
  for (int i = 0; i < 2000; ++i) {
    Drawn<TypeParam> contact = drawn<TypeParam>(random);
    contact.start.speed -= 2 * contact.start.depth;
    NormalOrbit orbit{{contact.start.per_depth, contact.start.elastic, contact.start.damping, contact.start.adhesion,
                       TypeParam::kExponent > 1},
                      contact.start.depth,
                      contact.start.speed,
                      contact.start.acceleration};
    orbit.advance(contact.step, 200, false);
    if (!orbit.has_parted) continue;
    ++parted;
    NormalSeries<TypeParam, Real> series;
    series.advance(contact.start, contact.step);
    EXPECT_FALSE(series.is_good());
  }
  EXPECT_GT(parted, 1000);
}

TYPED_TEST(NormalSeriesTest, WhatIsLetGoHasNoForceInSubsteps) {
  std::mt19937 random(8);
  int let_go = 0;
  for (int i = 0; i < 2000; ++i) {
    Drawn<TypeParam> contact = drawn<TypeParam>(random);
    contact.start.speed -= contact.start.depth;
    if (!is_let_go(contact.start, contact.step)) continue;
    ++let_go;
    const NormalKick<Real> found = in_substeps(contact);
    EXPECT_EQ(found.kick, 0);
    EXPECT_EQ(found.mean, 0);
  }
  EXPECT_EQ(let_go > 500, !TypeParam::kIsAdhesive);
}

TYPED_TEST(NormalSeriesTest, LanesFindWhatASingleContactFinds) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const Drawn<TypeParam> contact = drawn<TypeParam>(random), other = drawn<TypeParam>(random);
    NormalStart<RealLanes> start;
    const auto spread = [](Real first, Real second) {
      RealLanes lanes = RealLanes{} + first;
      if (kRealLanes > 1) lane(lanes, kRealLanes - 1) = second;
      return lanes;
    };
    start.depth = spread(contact.start.depth, other.start.depth);
    start.per_depth = spread(contact.start.per_depth, other.start.per_depth);
    start.speed = spread(contact.start.speed, other.start.speed);
    start.acceleration = spread(contact.start.acceleration, other.start.acceleration);
    start.elastic = spread(contact.start.elastic, other.start.elastic);
    start.damping = spread(contact.start.damping, other.start.damping);
    start.adhesion = spread(contact.start.adhesion, other.start.adhesion);
    NormalSeries<TypeParam, RealLanes> lanes;
    NormalSeries<TypeParam, Real> single;
    const NormalKick<RealLanes> found = lanes.advance(start, contact.step);
    const NormalKick<Real> expected = single.advance(other.start, contact.step);
    EXPECT_NEAR(lane(found.mean, kRealLanes - 1), expected.mean, 1e-13 * other.start.elastic);
    EXPECT_EQ(bits_of(lanes.is_good()) >> (kRealLanes - 1) & 1, bits_of(single.is_good()));
  }
}

}  // namespace
