// SPDX-License-Identifier: Apache-2.0
// Overlap integrals of random pairs of convex bodies against exact arithmetic, and the reference against closed forms.
// TALUS_EXACT_PAIRS=1000000 sets the number of pairs, TALUS_EXACT_TABLE=file writes the worst errors as a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>

#include "dem_gpu/narrow_phase/flush_planes.h"
#include "tests/property/dem_gpu/exact/exact_overlap.h"
#include "tests/property/dem_gpu/exact/random_pairs.h"
#include "tests/support/dem_scenes.h"

namespace {

using dem_gpu::BodyPose;
using dem_gpu::OverlapProbe;
using dem_gpu::OverlapSolid;
using dem_gpu::Vec3;
using exact::Pair;

using test_support::kPairGoal;

/// Share of a class that may be touching or apart. In single precision more is: half the depths of one class are below
/// its tolerance.
constexpr double kMostTouching = test_support::kIsMixed ? 0.9 : 0.6;
/// Smaller overlaps are compared to this, over the cube of the bodies' size: a millionth of the size across, they are
/// made anew by the rounding of the input.
constexpr double kSmallest = 1e-18;

struct Errors {
  int pairs = 0, touching = 0, ill_conditioned = 0, exact = 0, may_be_flush = 0;
  double volume_plain = 0;    // over V, where well conditioned
  double volume_smaller = 0;  // over the volume of the smaller body
  double volume = 0;          // over exact::Overlap::volume_scale
  double area = 0;            // over exact::Overlap::area_scale
  double moment = 0;          // over that times the bodies' size
  double symmetry = 0;        // the worst of V(A,B) - V(B,A) and of S(B,A), scaled likewise
};

dem_gpu::Shape shape_of(const catalog::ConvexPart& part) {
  return {"", dem_gpu::PolyhedralShape{{part}}, catalog::volume_moments(triangulated(part)).volume, {}};
}

double size_of(const catalog::ConvexPart& part, const BodyPose& pose) {
  double largest = 0;
  for (const catalog::Point& p : part.vertices) largest = std::max(largest, norm(test_support::to_vec3(p)));
  return pose.scale * largest;
}

/// The engine's rule.
exact::FlushRule flush_rule(const catalog::ConvexPart& part_a, const BodyPose& a, const catalog::ConvexPart& part_b,
                            const BodyPose& b) {
  const auto radius = [](const catalog::ConvexPart& part, const BodyPose& pose) {
    return pose.scale * dem_gpu::make_host_shape_columns({shape_of(part)}, 1).shapes[0].bounding_radius;
  };
  const auto rule = dem_gpu::FlushRule::of(radius(part_a, a), radius(part_b, b), b.position - a.position);
  return {rule.middle, rule.reach, rule.tolerance};
}

bool is_finite(const OverlapSolid& overlap) {
  const double sum = overlap.volume + norm(overlap.area) + norm(overlap.area_moment) + norm(overlap.centroid);
  return std::isfinite(sum);
}

void compare(const Pair& pair, Errors& worst) {
  const OverlapProbe probe(shape_of(pair.part_a), shape_of(pair.part_b), dem_gpu::OverlapVolume{1});
  const OverlapProbe swapped(shape_of(pair.part_b), shape_of(pair.part_a), dem_gpu::OverlapVolume{1});
  const OverlapSolid ab = probe.overlap(pair.poses), ba = swapped.overlap({pair.poses.b, pair.poses.a});
  ASSERT_TRUE(is_finite(ab) && is_finite(ba));
  const exact::FlushRule rule = flush_rule(pair.part_a, pair.poses.a, pair.part_b, pair.poses.b);
  const exact::Body a{pair.part_a, pair.poses.a}, b{pair.part_b, pair.poses.b};
  const exact::Overlap exact = exact::overlap(a, b, rule);
  const double tolerance = rule.tolerance;
  const double size = size_of(pair.part_a, pair.poses.a) + size_of(pair.part_b, pair.poses.b);
  const auto volume_of = [](const catalog::ConvexPart& part, const BodyPose& pose) {
    return std::pow(pose.scale, 3) * catalog::volume_moments(triangulated(part)).volume;
  };
  const double smaller = std::min(volume_of(pair.part_a, pair.poses.a), volume_of(pair.part_b, pair.poses.b));
  // Thinner than the engine tells from touching: whether it and its faces count is a convention.
  const bool is_touching = exact.volume <= 2 * tolerance * exact.surface;
  // Nothing overlaps, or so little that the rounding of the input makes it anew.
  // In single precision the rounding of the input makes all of these anew.
  const bool is_made_anew = test_support::kIsMixed && is_touching;
  const double volume_scale =
      exact.volume > 0 && !is_made_anew ? std::max(exact.volume_scale(size), kSmallest * size * size * size) : smaller;
  // Of two flush faces one body's stand for both.
  const double error = std::max(0.0, std::abs(ab.volume - exact.volume) - exact.flush_volume);
  const auto raise = [](double& value, double to) { value = std::max(value, to); };
  ++worst.pairs;
  worst.ill_conditioned += exact.volume > 0 && !exact.is_well_conditioned(size);
  worst.exact += exact.needed_exact;
  if (exact.is_well_conditioned(size)) raise(worst.volume_plain, error / exact.volume);
  raise(worst.volume_smaller, error / smaller);
  raise(worst.volume, error / volume_scale);
  raise(worst.symmetry, std::max(0.0, std::abs(ab.volume - ba.volume) - 2 * exact.flush_volume) / volume_scale);
  worst.touching += is_touching;
  worst.may_be_flush += exact.may_be_flush;
  if (is_touching || exact.may_be_flush) return;
  const double area_scale = exact.area_scale(size);
  raise(worst.area, norm(ab.area - exact.area) / area_scale);
  raise(worst.moment, norm(ab.area_moment - exact.area_moment) / (area_scale * size));
  // Seen from b, within its reach, other faces may be flush.
  const exact::Overlap seen_from_b = exact::overlap(b, a, flush_rule(pair.part_b, b.pose, pair.part_a, a.pose));
  if (!seen_from_b.may_be_flush) raise(worst.symmetry, norm(ba.area - seen_from_b.area) / seen_from_b.area_scale(size));
}

double worst_of(const Errors& e) { return std::max({e.volume, e.volume_smaller, e.area, e.moment, e.symmetry}); }

void write_row(std::ostream& out, const std::string& name, const Errors& e) {
  out << "| " << name << " | " << e.pairs << " | " << e.touching << " | " << e.ill_conditioned << " | " << e.exact
      << std::scientific << std::setprecision(1);
  for (const double value : {e.volume_plain, e.volume_smaller, e.volume, e.area, e.moment, e.symmetry})
    out << " | " << value;
  out << " |\n" << std::defaultfloat;
}

int pair_count() {
  const char* text = std::getenv("TALUS_EXACT_PAIRS");
  return text ? std::atoi(text) : 3000;
}

TEST(OverlapIntegrals, EqualExactArithmeticOnRandomPairs) {
  const char* file = std::getenv("TALUS_EXACT_TABLE");
  std::ofstream table(file ? file : "/dev/null");
  table << "| class | pairs | touching or apart | ill-conditioned | rationals needed | V over V | V over smaller body "
           "| V "
           "| S | M | symmetry |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  unsigned seed = 1;
  for (const exact::PairClass& kind : exact::pair_classes()) {
    exact::Random random(seed);
    Errors worst;
    const int count = std::max(1, pair_count() / 100 * kind.share);
    for (int i = 0; i < count; ++i) {
      const bool was_right = worst_of(worst) <= kPairGoal;
      compare(kind.make(random), worst);
      if (was_right && worst_of(worst) > kPairGoal)
        ADD_FAILURE() << kind.name << ", pair " << i << " of seed " << seed << ": error " << worst_of(worst);
      if (HasFatalFailure()) FAIL() << kind.name << ", pair " << i << " of seed " << seed;
    }
    EXPECT_LT(worst.may_be_flush, 0.02 * worst.pairs + 3) << kind.name << ": too few pairs tell S";
    EXPECT_LT(worst.touching, kMostTouching * worst.pairs) << kind.name << ": too few pairs overlap to say anything";
    write_row(table, kind.name, worst);
    table.flush();
    ++seed;
  }
}

exact::Overlap exact_overlap(const Pair& pair) {
  return exact::overlap({pair.part_a, pair.poses.a}, {pair.part_b, pair.poses.b}, {});
}

TEST(ExactOverlap, EqualsClosedForms) {
  using dem_gpu::axis_angle;
  const auto cube = test_support::unit_cube();
  // Dyadic numbers: not a bit may be wrong.
  const exact::Overlap shifted = exact_overlap({cube, cube, {{}, {{0.875, 0.25, 0.125}, {}}}});
  EXPECT_EQ(shifted.volume, 0.125 * 0.75 * 0.875);
  EXPECT_EQ(shifted.area, (Vec3{0.75 * 0.875, 0.125 * 0.875, 0.125 * 0.75}));
  EXPECT_EQ(exact_overlap({cube, cube, {{}, {{0, 0, 1}, {}}}}).volume, 0) << "face on face";
  EXPECT_EQ(exact_overlap({cube, cube, {}}).volume, 1) << "coincident";
  // Quaternions are rounded.
  const dem_gpu::Quaternion eighth = axis_angle({0, 0, 1}, std::acos(-1) / 4);
  EXPECT_NEAR(exact_overlap({cube, cube, {{}, {{}, eighth}}}).volume, 2 * (std::sqrt(2.0) - 1), 1e-15);
  const auto one = test_support::tetrahedron(), two = test_support::tetrahedron(1, true);
  EXPECT_NEAR(exact_overlap({one, two, {}}).volume, 1.0 / 6, 1e-16);
  EXPECT_NEAR(exact_overlap({cube, test_support::octahedron(1), {}}).volume, 5.0 / 6, 1e-15);
}

TEST(ExactOverlap, FilterAgreesWithRationals) {
  exact::Random random(99);
  for (const exact::PairClass& kind : exact::pair_classes())
    for (int i = 0; i < 3; ++i) {
      const Pair pair = kind.make(random);
      const exact::Body a{pair.part_a, pair.poses.a}, b{pair.part_b, pair.poses.b};
      const exact::Overlap filtered = exact::overlap(a, b, {}), rational = exact::overlap_unfiltered(a, b, {});
      const double size = size_of(pair.part_a, pair.poses.a) + size_of(pair.part_b, pair.poses.b);
      // Half the width that the filter accepts.
      EXPECT_LE(std::abs(filtered.volume - rational.volume), 2e-11 * rational.volume_scale(size)) << kind.name;
      EXPECT_LE(norm(filtered.area - rational.area), 4e-11 * rational.area_scale(size)) << kind.name;
      EXPECT_LE(norm(filtered.area_moment - rational.area_moment), 4e-11 * size * rational.area_scale(size))
          << kind.name;
    }
}

}  // namespace
