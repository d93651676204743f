// SPDX-License-Identifier: Apache-2.0
// Overlap integrals against closed forms: pairs whose overlap is known exactly.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::axis_angle;
using dem_gpu::HalfSpace;
using dem_gpu::VolumeIntegrals;

constexpr Real kQuarter = std::numbers::pi / 4;

struct Case {
  const char* name;
  catalog::ConvexPart part_a, part_b;
  Placed a, b;
  Real volume;
  Vec3 centroid;           // world
  Real tolerance = 1e-12;  // relative to the volume
};

std::vector<Case> cases() {
  const Real third = 1 / std::sqrt(Real(3)), d = std::numbers::sqrt2 - 1.4;
  const Vec3 far{1e6, 1e6, 1e6};
  std::vector<Case> all{
      {"O1 shifted cubes", unit_cube(), unit_cube(), {}, {{0.9, 0.3, 0.2}, {}}, 0.056, {0.45, 0.15, 0.10}},
      {"O2 turned 45 degrees",
       unit_cube(),
       unit_cube(),
       {},
       {{}, axis_angle({0, 0, 1}, kQuarter)},
       2 * (std::numbers::sqrt2 - 1),
       {}},
      {"O3 turned 60 degrees about the diagonal",
       unit_cube(),
       unit_cube(),
       {},
       {{}, axis_angle({third, third, third}, std::numbers::pi / 3)},
       0.75,
       {}},
      {"O4 dual tetrahedra", tetrahedron(), tetrahedron(1, true), {}, {}, 1.0 / 6, {}},
      {"O5 cuboctahedron", unit_cube(), octahedron(1), {}, {}, 5.0 / 6, {}},
      {"O7 crossing edges",
       unit_cube(),
       unit_cube(),
       {{}, axis_angle({1, 0, 0}, kQuarter)},
       {{0, 0, 1.4}, axis_angle({0, 1, 0}, kQuarter)},
       2.0 / 3 * d * d * d,
       {0, 0, 0.7},
       1e-11},
      {"O8 vertex in a face",
       unit_cube(),
       unit_cube(),
       {},
       {{0, 0, 0.5 + std::sqrt(3.0) / 2 - 0.05}, vertex_down()},
       std::sqrt(3.0) / 2 * 0.05 * 0.05 * 0.05,
       {0, 0, 0.4875},
       1e-11},
      {"O9 faces parallel to 1e-6",
       unit_cube(),
       unit_cube(),
       {},
       {{0, 0, 0.999}, axis_angle({1, 0, 0}, 1e-6)},
       9.9999950050025e-4,
       {0, 2.5e-7 - 1e-6 / 12 / 9.9999950050025e-4, 0.4995},
       1e-11},
      {"O10 needle",
       unit_cube(),
       dem_gpu::box_part({2, 0.001, 0.001}),
       {},
       {{}, axis_angle({0, 0, 1}, std::numbers::pi / 6)},
       1.15470053837925e-6,
       {},
       1e-11},
      // The poses themselves are rounded to 1.2e-10 there: 0.5 ulp in each of three offsets moves V by 7e-10.
      {"O11 far from the origin",
       unit_cube(),
       unit_cube(),
       {far, {}},
       {far + Vec3{0.9, 0.3, 0.2}, {}},
       0.056,
       far + Vec3{0.45, 0.15, 0.10},
       1e-9},
      {"O11 far, exact offsets",
       unit_cube(),
       unit_cube(),
       {far, {}},
       {far + Vec3{0.875, 0.25, 0.125}, {}},
       0.125 * 0.75 * 0.875,
       far + Vec3{0.4375, 0.125, 0.0625}},
      {"O12 coincident", unit_cube(), unit_cube(), {}, {}, 1, {}},
      {"O12 inside", unit_cube(), dem_gpu::box_part({0.5, 0.4, 0.3}), {}, {{0.1, 0, 0}, {}}, 0.06, {0.1, 0, 0}},
  };
  // O6: cube [0,1]^3 and x + y + z <= t; the half-space as a large cube standing on its face.
  for (const Real t : {0.1, 0.5, 1.0}) {
    const Vec3 n{third, third, third};
    all.push_back({"O6 corner cut",
                   unit_cube(),
                   dem_gpu::box_part({20, 20, 20}),
                   {{0.5, 0.5, 0.5}, {}},
                   {(t * third - 10) * n, turn_between({0, 0, 1}, n)},
                   t * t * t / 6,
                   Vec3{t, t, t} / 4,
                   2e-12 / (t * t * t)});
  }
  all.push_back({"O6 half",
                 unit_cube(),
                 dem_gpu::box_part({20, 20, 20}),
                 {{0.5, 0.5, 0.5}, {}},
                 {(1.5 * third - 10) * Vec3{third, third, third}, turn_between({0, 0, 1}, {third, third, third})},
                 0.5,
                 {1, 1, 1},
                 1e-12});
  all.back().centroid = {};  // not stated
  return all;
}

TEST(OverlapIntegrals, EqualClosedForms) {
  for (const Case& c : cases()) {
    const PairIntegrals pair({c.part_a}, {c.part_b});
    const auto ab = pair.of<VolumeIntegrals>(c.a, c.b);
    EXPECT_NEAR(ab.volume / c.volume, 1, c.tolerance + kSingle.relative) << c.name;
    if (std::string(c.name) == "O6 half") continue;
    const Vec3 centroid = rotate(c.a.orientation, ab.centroid()) + c.a.position;
    EXPECT_LT(norm(centroid - c.centroid), std::max(c.tolerance * norm(c.centroid), 1e-9) + kSingle.relative) << c.name;
  }
}

TEST(OverlapIntegrals, AreSymmetricInTheBodies) {
  for (const Case& c : cases()) {
    const PairIntegrals pair({c.part_a}, {c.part_b});
    const auto ab = pair.of<VolumeIntegrals>(c.a, c.b), ba = pair.of<VolumeIntegrals>(c.b, c.a, true);
    EXPECT_NEAR(ab.volume / ba.volume, 1, c.tolerance + kSingle.relative) << c.name;
    const Vec3 area_a = rotate(c.a.orientation, ab.area), area_b = rotate(c.b.orientation, ba.area);
    EXPECT_LT(norm(area_a + area_b), 1e-12 * std::cbrt(c.volume * c.volume) + 1e-14 + kSingle.integral) << c.name;
  }
}

TEST(OverlapIntegrals, TouchingBodiesShareNothing) {
  const PairIntegrals cubes({unit_cube()}, {unit_cube()});
  EXPECT_EQ(cubes.volume({}, {{0, 0, 1}, {}}), 0) << "face on face";
  EXPECT_EQ(cubes.volume({}, {{0.3, 0.2, 1}, {}}), 0) << "face on face, shifted";
  EXPECT_EQ(cubes.volume({}, {{0, 1, 1}, {}}), 0) << "edge on edge";
  EXPECT_EQ(cubes.volume({}, {{1, 1, 1}, {}}), 0) << "vertex on vertex";
  EXPECT_NEAR(cubes.volume({}, {{0, 0, 0.5 + std::sqrt(3.0) / 2}, vertex_down()}), 0, 1e-40) << "vertex on face";
  EXPECT_NEAR(cubes.volume({}, {{0, 0, 0.5 + std::sqrt(0.5)}, edge_down()}), 0, 1e-30) << "edge on face";
}

TEST(OverlapIntegrals, FlushFacesCountOnceHoweverTheBodiesStand) {
  // Two cubes stacked with all side faces flush, and one cube in itself, in 200 common attitudes: rounding may put a
  // flush face on either side of its partner.
  std::mt19937 random(7);
  const PairIntegrals cubes({unit_cube()}, {unit_cube()});
  for (int i = 0; i < 200; ++i) {
    const Quaternion turn = random_rotation(random);
    const Vec3 centre = 3 * random_direction(random);
    EXPECT_NEAR(cubes.volume({centre, turn}, {centre + rotate(turn, {0, 0, 0.99}), turn}), 0.01,
                1e-11 + kSingle.integral);
    EXPECT_NEAR(cubes.volume({centre, turn}, {centre, turn}), 1, 1e-11 + kSingle.integral);
    EXPECT_NEAR(cubes.volume({centre, turn}, {centre + rotate(turn, {0, 0, 1}), turn}), 0, 1e-14 + kSingle.integral);
  }
}

/// Where a body stands that is turned by a small vector.
Placed nearly(const Vec3& position, const Vec3& turn) {
  return {position, dem_gpu::normalized(Quaternion{1, turn.x / 2, turn.y / 2, turn.z / 2})};
}

TEST(OverlapIntegrals, APlatesSidesMayBeFlushButForNoise) {
  // Seen from the box some sides were flush, seen from the plate they were not, and counted twice.
  const PairIntegrals pair({unit_cube()}, {dem_gpu::box_part({1, 1, 0.01})});
  const Placed plate = nearly({-6.02e-13, 3.8e-14, 0.50250000000027695}, {1.132e-12, -2.34e-13, -8.56e-13});
  EXPECT_NEAR(pair.volume({}, plate), 0.0025, 1e-12 + kSingle.integral);
  EXPECT_NEAR(pair.of<VolumeIntegrals>(plate, {}, true).volume, 0.0025, 1e-12 + kSingle.integral);
  const Vec3 area = pair.of<VolumeIntegrals>({}, plate).area;
  EXPECT_NEAR(area.z, 1, 1e-12 + kSingle.integral);
  EXPECT_LT(std::hypot(area.x, area.y), 0.01);
}

TEST(OverlapIntegrals, FacesComeOutOfOnePlaneWithoutAJump) {
  // Tilts and offsets from rounding to far above it, for plates whose sides, or sides and one face, lie in those of a
  // box, and for plates on top of it. What is out of a flush plane changes V by tilt and offset times the surface.
  struct Stand {
    const char* name;
    Vec3 plate, position;
    Real volume, surface;
  };
  const Stand stands[] = {{"sides flush", {1, 1, 0.01}, {0, 0, 0.5025}, 0.0025, 2.1},
                          {"sides and top flush", {1, 1, 0.01}, {0, 0, 0.495}, 0.01, 2.1},
                          {"one corner flush", {0.3, 0.4, 0.01}, {0.35, -0.3, 0.495}, 0.0012, 0.3},
                          {"on top, sides flush", {1, 1, 0.01}, {0, 0, 0.505}, 0, 1},
                          {"on top", {0.4, 1.7, 0.2}, {0.1, 0.2, 0.6}, 0, 0.5}};
  std::mt19937 random(29);
  for (const Stand& stand : stands) {
    const PairIntegrals pair({unit_cube()}, {dem_gpu::box_part(stand.plate)});
    for (Real tilt = 1e-16; tilt < 2e-6; tilt *= std::sqrt(10.0))
      for (const Real offset : {0.0, 1e-15, 1e-13, 1e-12, 1e-11, 1e-9}) {
        const Placed plate =
            nearly(stand.position + offset * random_direction(random), tilt * random_direction(random));
        const Real noise = tilt + offset, tolerance = stand.surface * noise + 1e-12 + kSingle.integral;
        const auto ab = pair.of<VolumeIntegrals>({}, plate), ba = pair.of<VolumeIntegrals>(plate, {}, true);
        EXPECT_NEAR(ab.volume, stand.volume, tolerance) << stand.name << ", " << tilt << ", " << offset;
        EXPECT_NEAR(ba.volume, stand.volume, tolerance) << stand.name << ", " << tilt << ", " << offset;
      }
  }
}

TEST(OverlapIntegrals, BodiesThatTouchShareTheirWholeFaceAtOnce) {
  // A cube pressed onto another by next to nothing: V is the depth times the face, S the face.
  const PairIntegrals cubes({unit_cube()}, {unit_cube()});
  for (const Real depth : {1e-14, 1e-13, 1e-12, 1e-11, 1e-9}) {
    const auto overlap = cubes.of<VolumeIntegrals>({}, {{0, 0, 1 - depth}, {}});
    if (kIsMixed && overlap.volume <= 0) continue;  // lost to rounding
    EXPECT_NEAR(overlap.volume, depth, 2e-16 + kSingle.integral);
    EXPECT_LT(norm(overlap.area - Vec3{0, 0, 1}), 1e-6 + kSingle.relative) << depth;
  }
}

TEST(OverlapIntegrals, PartsAddUp) {
  // A cube of 8 parts overlaps as the whole cube does; inner faces cancel in S and M.
  std::mt19937 random(3);
  const PairIntegrals whole({unit_cube()}, {tetrahedron(1.5)});
  const PairIntegrals parts(cut_box({1, 1, 1}, {2, 2, 2}), {tetrahedron(1.5)});
  for (int i = 0; i < 50; ++i) {
    const Placed b{0.8 * random_direction(random), random_rotation(random)};
    const auto one = whole.of<VolumeIntegrals>({}, b), eight = parts.of<VolumeIntegrals>({}, b);
    EXPECT_NEAR(one.volume, eight.volume, 1e-14 + kSingle.integral);
    EXPECT_LT(norm(one.area - eight.area), 1e-13 + kSingle.integral);
    EXPECT_LT(norm(one.area_moment - eight.area_moment), 1e-13 + kSingle.integral);
    EXPECT_LT(norm(one.centroid() - eight.centroid()), 1e-9 + kSingle.relative);
  }
}

TEST(OverlapIntegrals, AreaAndMomentAreTheGradientOfTheVolume) {
  // Moving a by u changes V by S . u, turning it about its centre by r changes V by M . r.
  std::mt19937 random(11);
  const PairIntegrals pair({unit_cube()}, {tetrahedron(1.5)});
  const Real h = kIsMixed ? 1e-3 : 1e-5;
  for (int i = 0; i < 20; ++i) {
    const Placed b{0.7 * random_direction(random), random_rotation(random)};
    const auto integrals = pair.of<VolumeIntegrals>({}, b);
    if (integrals.volume < 1e-3) continue;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Real shifted = (pair.volume({h * axis, {}}, b) - pair.volume({-h * axis, {}}, b)) / (2 * h);
      const Real turned =
          (pair.volume({{}, axis_angle(axis, h)}, b) - pair.volume({{}, axis_angle(axis, -h)}, b)) / (2 * h);
      EXPECT_NEAR(shifted, dot(integrals.area, axis), 1e-9 + kSingle.slope);
      EXPECT_NEAR(turned, dot(integrals.area_moment, axis), 1e-9 + kSingle.slope);
    }
  }
}

TEST(SeparatingPlaneCache, NeverChangesTheResult) {
  std::mt19937 random(5);
  const PairIntegrals pair({random_convex_part(random, 12)}, {random_convex_part(random, 12, {1, 0.6, 0.4})});
  const auto& columns = pair.columns();
  const dem_gpu::ShapeView shapes = view(columns);
  const Placed a;
  dem_gpu::SeparatingPlane kept = 0;
  Vec3 position = 2.5 * random_direction(random);
  int separated = 0, overlapping = 0;
  for (int i = 0; i < 20000; ++i) {  // a body on a random walk about the other
    position += 0.05 * random_direction(random) - 0.002 * position;
    const Placed b{position, random_rotation(random)};
    VolumeIntegrals fresh, cached;
    dem_gpu::SeparatingPlane none = 0;
    dem_gpu::integrate_bodies(shapes, 0, 1, a.pose(), b.pose(), &none, fresh);
    dem_gpu::integrate_bodies(shapes, 0, 1, a.pose(), b.pose(), &kept, cached);
    ASSERT_NEAR(fresh.volume, cached.volume, 1e-15);
    (fresh.volume > 0 ? overlapping : separated) += 1;
  }
  EXPECT_GT(separated, 1000);
  EXPECT_GT(overlapping, 1000);
}

}  // namespace
