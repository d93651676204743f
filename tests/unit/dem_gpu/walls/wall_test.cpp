// SPDX-License-Identifier: Apache-2.0
// Analytic walls: distances against points of the surface, integrals against closed forms, prescribed motion.
#include <gtest/gtest.h>

#include <numbers>

#include "dem_gpu/walls/disc_integrals.h"
#include "dem_gpu/walls/wall_motion.h"
#include "tests/support/pair_integrals.h"
#include "tests/support/wall_records.h"

namespace {

using namespace test_support;
using dem_gpu::surface_distance;
using dem_gpu::WallIntegrals;
using dem_gpu::WallRecord;
using dem_gpu::WallSet;

/// Least distance from x to points of the surface of revolution whose generator runs from (r0, z0) to (r1, z1).
Real sampled_distance(const WallRecord& wall, const Vec3& x, Real r0, Real z0, Real r1, Real z1) {
  const Vec3 side = dem_gpu::any_perpendicular(wall.direction), other = cross(wall.direction, side);
  Real nearest = 1e300;
  for (int turn = 0; turn < 720; ++turn)
    for (int i = 0; i <= 200; ++i) {
      const Real t = i / 200.0, angle = turn * std::numbers::pi / 360;
      const Vec3 point = wall.point + (z0 + t * (z1 - z0)) * wall.direction +
                         (r0 + t * (r1 - r0)) * (std::cos(angle) * side + std::sin(angle) * other);
      nearest = std::min(nearest, norm(x - point));
    }
  return nearest;
}

TEST(WallSurface, DistanceOfEachKind) {
  const Vec3 axis = Vec3{1, 2, 2} / 3, base{0.1, -0.2, 0.3};
  struct Kind {
    WallRecord wall;
    Real r0, z0, r1, z1;
  };
  const Kind kinds[] = {{record_of(dem_gpu::Disc{base, axis, 1}), 0, 0, 1, 0},
                        {record_of(dem_gpu::Cylinder{base, axis, 2, 1}), 1, 0, 1, 2},
                        {record_of(dem_gpu::Cone{base, axis, 1.5, 0.4, 1.2}), 0.4, 0, 1.2, 1.5}};
  std::mt19937 random(1);
  for (const Kind& kind : kinds)
    for (int i = 0; i < 40; ++i) {
      const Vec3 x = base + std::uniform_real_distribution<Real>(0, 2)(random) * random_direction(random);
      const auto found = surface_distance(kind.wall, x);
      const Real sampled = sampled_distance(kind.wall, x, kind.r0, kind.z0, kind.r1, kind.z1);
      // Neighbouring sample points are 0.01 apart: the sampled distance is too large by at most 0.01^2 / (2 distance).
      EXPECT_LE(std::abs(found.depth), sampled + 1e-12);
      EXPECT_NEAR(std::abs(found.depth), sampled, 1e-3 + 1e-4 / (sampled + 0.05));
      EXPECT_NEAR(norm(found.into_wall), 1, 1e-12);
      // Following the direction by the distance ends on the surface.
      EXPECT_LT(sampled_distance(kind.wall, x - found.depth * found.into_wall, kind.r0, kind.z0, kind.r1, kind.z1),
                0.011);
    }
  const WallRecord plane = record_of(dem_gpu::Plane{base, axis});
  EXPECT_NEAR(surface_distance(plane, base - 0.3 * axis).depth, 0.3, 1e-15);
  EXPECT_NEAR(surface_distance(plane, base + 0.2 * axis).depth, -0.2, 1e-15);
}

TEST(WallSurface, SolidIsOutsideCylinderAndConeAndBehindDisc) {
  const auto cylinder = record_of(dem_gpu::Cylinder{{0, 0, 0}, {0, 0, 1}, 2, 1});
  EXPECT_NEAR(surface_distance(cylinder, {1.1, 0, 1}).depth, 0.1, 1e-15);
  EXPECT_NEAR(surface_distance(cylinder, {0, 0.7, 1}).depth, -0.3, 1e-15);
  EXPECT_NEAR(surface_distance(cylinder, {0, 0.7, 1}).into_wall.y, 1, 1e-15);
  const auto cone = record_of(dem_gpu::Cone{{0, 0, 0}, {0, 0, 1}, 1, 1, 2});  // 45 degrees
  EXPECT_NEAR(surface_distance(cone, {1, 0, 0.5}).depth, -0.5 / std::numbers::sqrt2, 1e-15);
  EXPECT_NEAR(wall_field(cone, {2, 0, 0.5}).depth, 0.5 / std::numbers::sqrt2, 1e-15);
  const auto disc = record_of(dem_gpu::Disc{{0, 0, 0}, {0, 0, 1}, 1});
  EXPECT_NEAR(surface_distance(disc, {0.2, 0, -0.1}).depth, 0.1, 1e-15);
  EXPECT_NEAR(surface_distance(disc, {1.3, 0, 0.4}).depth, -0.5, 1e-15) << "distance to the rim";
}

WallIntegrals integrate(const std::vector<catalog::ConvexPart>& parts, const Placed& body, const WallRecord& wall) {
  const PairIntegrals shapes(parts, {unit_cube()});
  WallIntegrals integrals;
  for (int p = 0; p < shapes.columns().shapes[0].part_count; ++p)
    integrate_part_in_plane(dem_gpu::part_view(view(shapes.columns()), p), body.pose(), wall, integrals);
  return integrals;
}

TEST(WallIntegrals, PlaneForceIsTheVolumeBelowIt) {
  // By the divergence theorem - integral of depth n dA over the closed overlap = V times the wall's normal, and its
  // moment V (centroid x normal); volume and centroid from the overlap with a large box.
  const WallRecord plane = record_of(dem_gpu::Plane{{0, 0, 0}, {0, 0, 1}});
  std::mt19937 random(4);
  const auto part = random_convex_part(random, 16, {0.6, 0.5, 0.4});
  const PairIntegrals pair({part}, {dem_gpu::box_part({10, 10, 10})});
  const Placed block{{0, 0, -5}, {}};
  for (int i = 0; i < 30; ++i) {
    const Placed body{{0.3, 0.2, 0.3}, random_rotation(random), 1};
    const auto volume = pair.of<dem_gpu::VolumeIntegrals>(body, block);
    const auto wall = integrate({part}, body, plane);
    EXPECT_LT(norm(wall.force - Vec3{0, 0, volume.volume}), 1e-13 + kSingle.integral);
    const Vec3 moment = volume.volume * cross(rotate(body.orientation, volume.centroid()), Vec3{0, 0, 1});
    EXPECT_LT(norm(wall.moment - moment), 1e-12 + kSingle.integral);
  }
}

TEST(WallIntegrals, ClosedFormsOfACubeOnAPlane) {
  const WallRecord plane = record_of(dem_gpu::Plane{{0, 0, 0}, {0, 0, 1}});
  const Real d = 0.01;
  const auto flat = integrate({unit_cube()}, {{0, 0, 0.5 - d}, {}}, plane);
  EXPECT_NEAR(flat.force.z, d, 1e-15 + kSingle.position * d);
  EXPECT_NEAR(norm(flat.area), 1, 1e-12 + kSingle.position);
  EXPECT_NEAR(flat.largest_depth, d, 1e-15 + kSingle.position * d);
  const auto edge = integrate({unit_cube()}, {{0, 0, std::sqrt(0.5) - d}, edge_down()}, plane);
  EXPECT_NEAR(edge.force.z / (d * d), 1, 1e-11 + 2 * kSingle.position / d);
  const auto vertex = integrate({unit_cube()}, {{0, 0, std::sqrt(0.75) - d}, vertex_down()}, plane);
  EXPECT_NEAR(vertex.force.z / (std::sqrt(0.75) * d * d * d), 1, 1e-9 + 3 * kSingle.position / d);
  // Eight parts: the same, inner faces do not count.
  const auto cut = integrate(cut_box({1, 1, 1}, {2, 2, 2}), {{0, 0, 0.5 - d}, {}}, plane);
  EXPECT_LT(norm(cut.force - flat.force), 1e-15 + kSingle.position * d);
  // At twice the scale and a quarter of the attitude's symmetry the force is that of the larger face.
  EXPECT_NEAR(integrate({unit_cube()}, {{0, 0, 1 - d}, {}, 2}, plane).force.z, 4 * d, 1e-14 + 4 * kSingle.position * d);
}

TEST(WallMotion, RampsAndTurns) {
  dem_gpu::Scene scene = empty_scene(1, 0);
  dem_gpu::Wall wall;
  wall.name = "lid";
  wall.geometry = dem_gpu::Disc{{2, 0, 0}, {1, 0, 0}, 1};
  wall.motion = {{1, 0, 0}, {0, 0, 2}, {0, 0, 3}, 0.5, 0.2};
  wall.removed_at = 2;
  scene.walls = {wall};
  WallSet walls(scene, 0);
  EXPECT_FALSE(walls.move_to(0.5));
  EXPECT_EQ(walls.records()[0].point, (Vec3{2, 0, 0})) << "at rest until the start";
  EXPECT_EQ(walls.records()[0].velocity, Vec3{});
  walls.move_to(0.6);  // half way up the ramp: half the speed, a quarter of the ramp's time at full speed travelled
  EXPECT_NEAR(walls.records()[0].velocity.z, 1.5, 1e-12);
  EXPECT_NEAR(walls.records()[0].angular_velocity.z, 1, 1e-12);
  EXPECT_NEAR(walls.records()[0].point.z, 3 * 0.025, 1e-12);
  const Real time = 1.5, turned = 2 * (time - 0.5 - 0.1);
  EXPECT_FALSE(walls.move_to(time));
  const WallRecord& now = walls.records()[0];
  EXPECT_LT(norm(now.point - Vec3{1 + std::cos(turned), std::sin(turned), 3 * 0.9}), 1e-12);
  EXPECT_LT(norm(now.direction - Vec3{std::cos(turned), std::sin(turned), 0}), 1e-12);
  EXPECT_LT(norm(rotate(walls.rotation(0), {2, 0, 0}) + walls.translation(0) - now.point), 1e-12);
  EXPECT_LT(norm(now.rotation_centre - Vec3{1, 0, 2.7}), 1e-12);
  // The velocity field is the rate of the motion.
  const Real h = 1e-6;
  walls.move_to(time + h);
  const Vec3 later = walls.records()[0].point;
  walls.move_to(time - h);
  const Vec3 earlier = walls.records()[0].point;
  walls.move_to(time);
  const Vec3 velocity = now.velocity + cross(now.angular_velocity, now.point - now.rotation_centre);
  EXPECT_LT(norm((later - earlier) / (2 * h) - velocity), 1e-8);
  EXPECT_TRUE(walls.records()[0].is_present);
  EXPECT_TRUE(walls.move_to(2)) << "the gate opens";
  EXPECT_FALSE(walls.records()[0].is_present);
  EXPECT_FALSE(walls.move_to(2.5));
}

TEST(WallMotion, SurfaceThatMapsOntoItselfDoesNotWearTheNeighbourList) {
  dem_gpu::Scene scene = empty_scene(1, 0);
  dem_gpu::Wall shell, lifter;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, 0, 0}, {0, 1, 0}, 1, 2};
  shell.motion.angular_velocity = {0, 3, 0};
  scene.walls = {shell};
  EXPECT_EQ(WallSet(scene, 0).largest_displacement(0, 1), 0);
  lifter.name = "lifter";
  lifter.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.2, 1, 0.2}), {}, {1.8, 0.5, 0})};
  lifter.motion = shell.motion;
  scene.walls = {shell, lifter};
  const Real reach = std::hypot(1.9, 0.1);
  EXPECT_NEAR(WallSet(scene, 0).largest_displacement(0, 0.1), 0.3 * reach, 1e-12);
}

TEST(WallMotion, OscillatesAboutItsPlaceAndAddsToTheRest) {
  dem_gpu::Motion motion;
  motion.velocity = {0, 0, 1};
  motion.amplitude = {0.2, 0, 0};
  motion.angular_amplitude = {0, 0.5, 0};
  motion.angular_velocity = {0, 0, 3};
  motion.frequency = 2;
  motion.phase = 0.7;
  motion.start_time = 0.1;
  motion.ramp_time = 0.3;
  EXPECT_EQ(place_at(motion, 0.1).shift, Vec3{});
  const Real time = 1.23, elapsed = time - 0.1;
  EXPECT_NEAR(place_at(motion, time).shift.x, 0.2 * (std::sin(4 * M_PI * elapsed + 0.7) - std::sin(0.7)), 1e-14);
  for (const Real t : {0.25, 1.23}) {  // in the ramp and past it
    const Real h = 1e-6;
    const auto before = place_at(motion, t - h), after = place_at(motion, t + h);
    const auto rate = rate_at(motion, t), mean = mean_rate(motion, t - h, t + h);
    const auto turn = after.rotation * conjugate(before.rotation);
    EXPECT_LT(norm((after.shift - before.shift) / (2 * h) - rate.velocity), 1e-8);
    EXPECT_LT(norm((1 / h) * Vec3{turn.x, turn.y, turn.z} - rate.angular_velocity), 1e-8);
    EXPECT_LT(norm(mean.velocity - rate.velocity) + norm(mean.angular_velocity - rate.angular_velocity), 1e-8);
  }
}

TEST(WallMotion, BoundOfTheTravelHoldsForEveryStep) {
  dem_gpu::Scene scene;
  dem_gpu::Wall floor;
  floor.geometry = dem_gpu::Plane{{0, 0, 0}, {0, 0, 1}};
  floor.motion.amplitude = {0, 0, 0.1};
  floor.motion.frequency = 5;
  floor.motion.phase = M_PI / 2;  // at rest as it starts
  scene.walls = {floor};
  const WallSet walls(scene, 0);
  const Real step = 1e-3;
  Real largest = 0;
  for (int i = 0; i < 400; ++i) largest = std::max(largest, walls.largest_displacement(i * step, (i + 1) * step));
  // The bound takes the greatest speed for all of the step: over by 2e-4 here, 5 Hz in steps of 1 ms.
  EXPECT_LE(largest, walls.largest_displacement(step));
  EXPECT_GE(largest, 0.999 * walls.largest_displacement(step));
}

TEST(WallSurface, PlateIsSolidBetweenItsFaces) {
  const auto plate = record_of(dem_gpu::Disc{{0, 0, 0}, {0, 0, 1}, 1, 0.2});
  EXPECT_NEAR(surface_distance(plate, {0.3, 0, 0.5}).depth, -0.5, 1e-15);
  EXPECT_NEAR(surface_distance(plate, {0.3, 0, -0.5}).depth, -0.3, 1e-15);
  EXPECT_NEAR(surface_distance(plate, {1.3, 0, 0.4}).depth, -0.5, 1e-15);
  EXPECT_NEAR(surface_distance(plate, {0.3, 0, -0.15}).depth, 0.05, 1e-15);
  EXPECT_NEAR(surface_distance(plate, {0.3, 0, -0.15}).into_wall.z, 1, 1e-15) << "nearer to the back";
}

TEST(WallIntegrals, DiscSmallerThanAFaceIsMet) {
  const WallRecord disc = record_of(dem_gpu::Disc{{0.1, 0.05, 0}, {0, 0, 1}, 0.2});
  const PairIntegrals shapes({unit_cube()}, {unit_cube()});
  const auto part = dem_gpu::part_view(view(shapes.columns()), 0);
  const Real d = 0.01;
  const Vec3 centre{0, 0, 0.5 - d};
  WallIntegrals integrals;
  ASSERT_TRUE(integrate_part_in_disc(dem_gpu::PlacedPart(part, {}), centre, disc, integrals));
  EXPECT_NEAR(integrals.force.z, M_PI * 0.04 * d, 1e-12 + kSingle.position * M_PI * 0.04)
      << "the rim's polygon has the disc's area";
  EXPECT_LT(norm(integrals.moment - cross(Vec3{0.1, 0.05, 0}, integrals.force)),
            1e-12 + kSingle.position * M_PI * 0.04);
}

TEST(WallSurface, BallInsideAndOutside) {
  const auto bowl = record_of(dem_gpu::Ball{{1, 0, 0}, 2});
  EXPECT_NEAR(surface_distance(bowl, {1, 1.5, 0}).depth, -0.5, 1e-15);
  EXPECT_NEAR(surface_distance(bowl, {1, 1.5, 0}).into_wall.y, 1, 1e-15);
  const auto ball = record_of(dem_gpu::Ball{{1, 0, 0}, 2, dem_gpu::SolidSide::within});
  EXPECT_NEAR(surface_distance(ball, {1, 2.5, 0}).depth, -0.5, 1e-15);
  EXPECT_NEAR(surface_distance(ball, {1, 2.5, 0}).into_wall.y, -1, 1e-15);
}

}  // namespace
