// SPDX-License-Identifier: Apache-2.0
// Force and torque of the depth potential on the random pairs of the exact test (needles and plates of aspect 50, faces
// parallel to 1e-9, vertices on faces, coincident bodies, far from the origin), against a plain version in double.
// TALUS_EXACT_PAIRS=20000 sets the number of pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "dem_gpu/narrow_phase/separating_plane.h"
#include "tests/property/dem_gpu/exact/random_pairs.h"
#include "tests/property/dem_gpu/plain_depth.h"
#include "tests/support/dem_scenes.h"
#include "tests/support/precision.h"

namespace {

using dem_gpu::BodyPose;
using dem_gpu::DepthPotential;
using dem_gpu::HardeningDepthPotential;
using dem_gpu::OverlapProbe;
using dem_gpu::PolyhedralLaw;
using dem_gpu::ProbeContact;
using exact::Pair;
using test_support::Vec3;

struct Sized {
  dem_gpu::Shape shape;
  double radius = 0;    // largest distance of a vertex from the origin, placed [m]
  double diameter = 0;  // equivalent, placed [m]
};

Sized sized(const catalog::ConvexPart& part, const BodyPose& pose) {
  Sized body{{"", dem_gpu::PolyhedralShape{{part}}, catalog::volume_moments(triangulated(part)).volume, {}}};
  for (const catalog::Point& p : part.vertices)
    body.radius = std::max(body.radius, pose.scale * norm(test_support::to_vec3(p)));
  body.diameter = pose.scale * std::cbrt(6 * body.shape.volume / std::numbers::pi);
  return body;
}

struct Errors {
  double force = 0, torque = 0, balance = 0;
  int compared = 0;
};

/// Errors over the integral of psi, or over what a shift of the input by a share of the size would change it by where
/// that is more than kConditioned times the share.
void compare(const Pair& pair, const PolyhedralLaw& law, double hardening, Errors& worst) {
  const Sized a = sized(pair.part_a, pair.poses.a), b = sized(pair.part_b, pair.poses.b);
  const double size = a.radius + b.radius;
  const double rate = hardening > 0 ? 1 / (hardening * std::min(a.diameter, b.diameter)) : 0;
  const double cap = dem_gpu::depth_potential(law)->depth_cap;
  const plain::DepthForce exact = plain::depth_force({pair.part_a, pair.poses.a, cap * a.diameter, rate},
                                                     {pair.part_b, pair.poses.b, cap * b.diameter, rate});
  const ProbeContact found = OverlapProbe(a.shape, b.shape, law).contact(pair.poses);
  const ProbeContact swapped = OverlapProbe(b.shape, a.shape, law).contact({pair.poses.b, pair.poses.a});
  const double sum = norm(found.force) + norm(found.torque_a) + norm(found.point) + found.depth + found.stiffness;
  ASSERT_TRUE(std::isfinite(sum));
  // Thinner or narrower than the engine tells from touching.
  const double tolerance = dem_gpu::kCoplanarity * size;
  if (exact.weight <= 2 * tolerance * exact.slope || exact.slope <= 2 * tolerance * size) return;
  ++worst.compared;
  const double scale = std::max(exact.weight, size * exact.slope / test_support::kConditioned);
  worst.force = std::max(worst.force, norm(found.force - exact.force) / scale);
  worst.balance = std::max(worst.balance, norm(found.force + swapped.force) / scale);
  if (hardening == 0) worst.torque = std::max(worst.torque, norm(found.torque_a - exact.torque) / (scale * size));
}

int pair_count() {
  const char* text = std::getenv("TALUS_EXACT_PAIRS");
  return text ? std::atoi(text) : 3000;
}

void expect_right(const PolyhedralLaw& law, double hardening) {
  unsigned seed = 1;
  for (const exact::PairClass& kind : exact::pair_classes()) {
    exact::Random random(seed++);
    Errors worst;
    const int count = std::max(1, pair_count() / 100 * kind.share);
    for (int i = 0; i < count; ++i) {
      compare(kind.make(random), law, hardening, worst);
      if (testing::Test::HasFatalFailure()) FAIL() << kind.name << ", pair " << i;
    }
    std::printf("  %-24s %6d pairs, %6d compared: force %.1e, torque %.1e, balance %.1e\n", kind.name.c_str(), count,
                worst.compared, worst.force, worst.torque, worst.balance);
    EXPECT_LT(std::max({worst.force, worst.torque, worst.balance}), test_support::kPairGoal) << kind.name;
    // The depth is zero all over coincident bodies' surfaces.
    EXPECT_TRUE(worst.compared > 0 || kind.name == "coincident") << kind.name;
  }
}

TEST(DepthPairs, EqualAPlainVersionInDouble) { expect_right(DepthPotential{1}, 0); }

TEST(DepthPairs, EqualAPlainVersionInDoubleWithHardening) {
  constexpr double kHardening = 0.03;
  expect_right(HardeningDepthPotential{{1}, kHardening}, kHardening);
}

}  // namespace
