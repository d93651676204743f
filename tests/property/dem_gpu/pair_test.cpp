// SPDX-License-Identifier: Apache-2.0
// Invariants of the contact of random convex bodies.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "dem_gpu/overlap_probe.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::axis_angle;
using dem_gpu::DepthIntegrals;
using dem_gpu::ElasticContact;
using dem_gpu::VolumeIntegrals;

struct RandomPair {
  PairIntegrals integrals;
  Placed a, b;
};

RandomPair random_pair(std::mt19937& random) {
  // From round bodies to plates and needles of aspect 50.
  const Vec3 forms[] = {{1, 1, 1}, {1, 0.7, 0.4}, {1, 1, 0.02}, {1, 0.02, 0.02}};
  std::uniform_int_distribution<int> form(0, 3), count(4, 16);
  std::uniform_real_distribution<Real> distance(0, 1.2);
  return {{{random_convex_part(random, count(random), forms[form(random)])},
           {random_convex_part(random, count(random), forms[form(random)])}},
          {{}, random_rotation(random)},
          {distance(random) * random_direction(random), random_rotation(random)}};
}

ElasticContact contact_of(const RandomPair& pair, const Placed& a, const Placed& b, bool swapped = false) {
  ElasticContact contact;
  pair.integrals.of<DepthIntegrals>(swapped ? b : a, swapped ? a : b, swapped)
      .to_contact(dem_gpu::DepthPotential{1}, (swapped ? b : a).pose(), contact);
  return contact;
}

TEST(RandomPairs, InvariantUnderACommonMotion) {
  std::mt19937 random(101);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const RandomPair pair = random_pair(random);
    const Quaternion turn = random_rotation(random);
    const Vec3 shift = 3 * random_direction(random);
    const auto moved = [&](const Placed& body) {
      return Placed{rotate(turn, body.position) + shift, turn * body.orientation};
    };
    const Placed a = moved(pair.a), b = moved(pair.b);
    const Real volume = pair.integrals.volume(pair.a, pair.b);
    EXPECT_NEAR(pair.integrals.volume(a, b), volume, 1e-13 + kSingle.integral);
    const ElasticContact before = contact_of(pair, pair.a, pair.b), after = contact_of(pair, a, b);
    EXPECT_LT(norm(after.force - rotate(turn, before.force)), 1e-13 + kSingle.integral);
    EXPECT_LT(norm(after.torque_a - rotate(turn, before.torque_a)), 1e-13 + kSingle.integral);
    touching += volume > 0;
  }
  EXPECT_GT(touching, 500);
}

TEST(RandomPairs, SymmetricInTheBodiesAndBounded) {
  std::mt19937 random(102);
  for (int i = 0; i < 3000; ++i) {
    const RandomPair pair = random_pair(random);
    const auto ab = pair.integrals.of<VolumeIntegrals>(pair.a, pair.b);
    const auto ba = pair.integrals.of<VolumeIntegrals>(pair.b, pair.a, true);
    EXPECT_NEAR(ab.volume, ba.volume, 1e-13 + kSingle.integral);
    EXPECT_LT(norm(rotate(pair.a.orientation, ab.area) + rotate(pair.b.orientation, ba.area)),
              1e-12 + kSingle.integral);
    const auto& columns = pair.integrals.columns();
    EXPECT_GE(ab.volume, -1e-15 - kSingle.integral);
    EXPECT_LE(ab.volume, std::min(columns.shapes[0].volume, columns.shapes[1].volume) * (1 + 1e-12 + kSingle.relative));
    const ElasticContact one = contact_of(pair, pair.a, pair.b), two = contact_of(pair, pair.a, pair.b, true);
    EXPECT_LT(norm(one.force + two.force), 1e-13 + kSingle.integral);
    const Vec3 torque_b = cross(pair.b.position - pair.a.position, one.force) - one.torque_a;
    EXPECT_LT(norm(torque_b - two.torque_a), 1e-13 + kSingle.integral);
    for (const Real value : {one.force.x, one.force.y, one.force.z, one.torque_a.x, one.depth, one.stiffness})
      EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(RandomPairs, VolumeIsConcaveAlongALine) {
  std::mt19937 random(103);
  for (int i = 0; i < 200; ++i) {
    const PairIntegrals pair({random_convex_part(random, 10)}, {random_convex_part(random, 10)});
    const Quaternion turn = random_rotation(random);
    const Vec3 direction = random_direction(random);
    // V^(1/3) of two convex bodies is concave along a line where they overlap (Brunn & Minkowski).
    Real values[41];
    for (int k = 0; k <= 40; ++k)
      values[k] = std::cbrt(std::max(Real(0), pair.volume({}, {(2.0 - 0.1 * k) * direction, turn})));
    for (int k = 1; k < 40; ++k) {
      const bool is_inside = values[k - 1] > 0 && values[k + 1] > 0;
      EXPECT_TRUE(!is_inside || values[k] >= (values[k - 1] + values[k + 1]) / 2 - 1e-9 - std::cbrt(kSingle.integral));
    }
  }
}

/// Work done by the contact on b along a closed path of b round a, over the largest energy swing on the way.
Real closed_path_work(const PairIntegrals& pair, const std::function<Placed(Real)>& path) {
  constexpr int kSteps = 4000;
  Real work = 0, lowest = 0, highest = 0;
  Placed before = path(0);
  for (int i = 1; i <= kSteps; ++i) {
    const Placed after = path(Real(i) / kSteps);
    const Placed middle = path((i - 0.5) / kSteps);
    ElasticContact contact;
    if (pair.of<DepthIntegrals>({}, middle).to_contact(dem_gpu::DepthPotential{1}, Placed{}.pose(), contact)) {
      const Vec3 torque_b = cross(middle.position, contact.force) - contact.torque_a;
      Quaternion turn = after.orientation * conjugate(before.orientation);
      if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
      work -= dot(contact.force, after.position - before.position);
      work += dot(torque_b, 2 * Vec3{turn.x, turn.y, turn.z});
    }
    lowest = std::min(lowest, work);
    highest = std::max(highest, work);
    before = after;
  }
  EXPECT_GT(highest, lowest) << "no contact on the path";
  return std::abs(work) / (highest - lowest);
}

TEST(ClosedPath, NoWorkIsLeft) {
  const Real turn = 2 * std::numbers::pi;
  const PairIntegrals cubes({unit_cube()}, {unit_cube()}),
      cut(cut_box({1, 1, 1}, {2, 2, 2}), cut_box({1, 1, 1}, {2, 1, 1}));
  const PairIntegrals mixed({unit_cube()}, {tetrahedron(1.5)});
  struct Path {
    const char* name;
    std::function<Placed(Real)> at;
  };
  const Path paths[] = {
      {"face slides off an edge",
       [=](Real t) {
         return Placed{{0.6 + 0.5 * std::cos(turn * t), 0.1, 0.97 + 0.05 * std::sin(turn * t)}, {}};
       }},
      {"edge over edge",
       [=](Real t) {
         return Placed{{0.7 + 0.2 * std::cos(turn * t), 0.2 * std::sin(turn * t), 0.8},
                       axis_angle({0, 1, 0}, 0.6 + 0.2 * std::sin(turn * t))};
       }},
      {"vertex wanders over a face",
       [=](Real t) {
         return Placed{{0.3 * std::cos(turn * t), 0.3 * std::sin(turn * t), 1.25 + 0.08 * std::cos(2 * turn * t)},
                       axis_angle({0, 0, 1}, 0.4 * std::sin(turn * t)) * vertex_down()};
       }},
      {"rocking on a face",
       [=](Real t) {
         return Placed{{0.1 * std::cos(turn * t), 0, 0.98 + 0.02 * std::sin(turn * t)},
                       axis_angle({0, 1, 0}, 0.1 * std::cos(turn * t))};
       }},
  };
  for (const Path& path : paths) {
    const Real whole = closed_path_work(cubes, path.at), parts = closed_path_work(cut, path.at),
               other = closed_path_work(mixed, [&](Real t) {
                 Placed lower = path.at(t);  // the tetrahedron is smaller
                 lower.position.z -= 0.25;
                 return lower;
               });
    std::printf("  %-28s cube %.1e, cube of parts %.1e, cube and tetrahedron %.1e of the swing\n", path.name, whole,
                parts, other);
    EXPECT_LT(whole, 1e-5) << path.name;
    EXPECT_LT(parts, 1e-5) << path.name;
    EXPECT_LT(other, 1e-5) << path.name;
  }
}

/// Upright prism over a regular polygon of `corners` corners, radius 1.
catalog::ConvexPart coin(int corners, Real height) {
  std::vector<Vec3> vertices;
  for (const Real z : {-height / 2, height / 2})
    for (int i = 0; i < corners; ++i) {
      const Real angle = 2 * std::numbers::pi * i / corners;
      vertices.push_back({std::cos(angle), std::sin(angle), z});
    }
  std::vector<std::vector<int>> loops(2);
  for (int i = 0; i < corners; ++i) {
    loops[0].push_back(corners + i);
    loops[1].push_back(corners - 1 - i);
    const int next = (i + 1) % corners;
    loops.push_back({i, next, corners + next, corners + i});
  }
  return part_of(vertices, loops);
}

// A face of many corners cut by many planes is many polygons.
TEST(Coins, LieOnOneAnother) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  constexpr Real kHeight = 0.4, kOverlap = 0.02;
  for (const int corners : {8, 20, dem_gpu::kMaxFaceCorners}) {
    const dem_gpu::Shape shape = dem_gpu::polyhedral_shape("coin", {coin(corners, kHeight)});
    const Real face = Real(0.5) * corners * std::sin(2 * std::numbers::pi / corners);
    const dem_gpu::OverlapProbe volumes(shape, shape, dem_gpu::OverlapVolume{1});
    const dem_gpu::OverlapProbe depths(shape, shape, dem_gpu::DepthPotential{1});
    for (int i = 0; i < 200; ++i) {
      const bool is_flat = i % 2 == 0;
      const Quaternion turn = axis_angle({0, 0, 1}, std::numbers::pi * uniform(random));
      const Quaternion tilt = axis_angle({1, 0, 0}, is_flat ? 0 : Real(0.02) * uniform(random));
      const Vec3 shift{is_flat ? 0 : Real(0.1) * uniform(random), 0, kHeight - kOverlap};
      const dem_gpu::PosePair poses{{}, {shift, tilt * turn, 1}};
      const Real volume = volumes.overlap(poses).volume;  // throws where pieces do not fit
      EXPECT_GT(volume, 0.5 * kOverlap * face);
      // Within both, and around the circles inscribed in both.
      const Real inscribed = std::numbers::pi * std::pow(std::cos(std::numbers::pi / corners), 2);
      if (is_flat) {
        EXPECT_LE(volume, kOverlap * face * (1 + 1e-9 + kSingle.integral));
        EXPECT_GE(volume, kOverlap * inscribed * (1 - 1e-9 - kSingle.integral));
      }
      EXPECT_GT(depths.contact(poses).force.z * -1, 0);
    }
  }
}

}  // namespace
