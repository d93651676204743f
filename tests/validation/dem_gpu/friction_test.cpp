// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr double kGravity = 9.81, kDegree = std::numbers::pi / 180;

/// A cube at rest on the floor, gravity turned by `angle` towards +x.
Scene incline(double angle, double friction, std::array<int, 3> parts = {1, 1, 1}) {
  Scene scene = empty_scene(0.5, friction);
  const Real edge = 0.02, mass = 2500 * edge * edge * edge;
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.gravity = kGravity * Vec3{std::sin(angle), 0, -std::cos(angle)};
  scene.shapes = {box_shape({edge, edge, edge}, parts)};
  scene.walls = {floor_wall()};
  const Real sunk = mass * kGravity * std::cos(angle) / (2e8 * edge * edge);
  scene.bodies = {body_at(0, {0, 0, edge / 2 - sunk})};
  return scene;
}

TEST(Incline, SticksBelowAndSlidesAboveTheFrictionAngle) {
  const double friction = 0.5, critical = std::atan(friction);
  for (const std::array<int, 3>& parts : {std::array<int, 3>{1, 1, 1}, {2, 2, 2}}) {
    Simulation below(incline(critical - 0.1 * kDegree, friction, parts));
    run_to(below, 0.5);
    const Vec3 early = below.snapshot().position[0];
    run_to(below, 1);
    const double creep = std::abs(below.snapshot().position[0].x - early.x) / 0.5;
    std::printf("  0.1 degree below the friction angle: creep %.1e m/s\n", creep);
    EXPECT_LT(creep, 1e-8);

    Simulation above(incline(critical + 0.1 * kDegree, friction, parts));
    run_to(above, 0.2);  // past the jerk of the start
    const double start = above.snapshot().velocity[0].x;
    run_to(above, 0.5);
    const double speed_gained = above.snapshot().velocity[0].x - start;
    const double acceleration =
        kGravity * (std::sin(critical + 0.1 * kDegree) - friction * std::cos(critical + 0.1 * kDegree));
    std::printf("  0.1 degree above: speed %.5f of g (sin - mu cos) t\n", speed_gained / (0.3 * acceleration));
    EXPECT_NEAR(speed_gained / (0.3 * acceleration), 1, 0.05);
  }
}

TEST(Incline, SlidingAcceleration) {
  for (const double degrees : {30.0, 40.0}) {
    Simulation simulation(incline(degrees * kDegree, 0.3));
    run_to(simulation, 0.1);
    const double early = simulation.snapshot().velocity[0].x;
    run_to(simulation, 0.6);
    const double got = (simulation.snapshot().velocity[0].x - early) / 0.5;
    const double expected = kGravity * (std::sin(degrees * kDegree) - 0.3 * std::cos(degrees * kDegree));
    std::printf("  incline %.0f degrees: acceleration %.6f of exact\n", degrees, got / expected);
    EXPECT_NEAR(got / expected, 1, 2e-3);
  }
}

TEST(SlidingBlock, StopsAfterItsWay) {
  // v0 5 m/s, mu 0.5: 2.54841998 m in 1.019367992 s, no turning aside.
  Scene scene = incline(0, 0.5);
  scene.bodies[0].velocity = {5, 0, 0};
  Simulation simulation(scene);
  run_to(simulation, 1.2);
  const auto end = simulation.snapshot();
  std::printf("  sliding block: way %.6f of exact, y %.1e m\n", end.position[0].x / 2.54841998, end.position[0].y);
  EXPECT_NEAR(end.position[0].x / 2.54841998, 1, 2e-3);
  EXPECT_NEAR(end.position[0].y, 0, 1e-9 + kSingle.path * 0.02) << "edge 0.02";
  EXPECT_LT(0.5 * 0.02 * norm_squared(end.velocity[0]), 1e-8);
}

TEST(Sphere, SlidingTurnsToRollingAtFiveSevenths) {
  for (const bool on_slab : {false, true}) {
    Scene scene = empty_scene(0.5, 0.3);
    scene.gravity = {0, 0, -kGravity};
    scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
    const Real mass = 2500 * scene.shapes[0].volume;
    scene.walls = {on_slab ? slab_wall() : floor_wall()};
    scene.bodies = {body_at(0, {-0.05, 0, 0.01 - mass * kGravity / 1e5}, {}, {1, 0, 0})};
    Simulation simulation(scene);
    run_to(simulation, 2 / (7 * 0.3 * kGravity));
    EXPECT_NEAR((simulation.snapshot().position[0].x + 0.05) / 0.0832137136, 1, 2e-3);
    run_to(simulation, 0.12);
    const auto end = simulation.snapshot();
    std::printf("  rolling on %s: %.6f of 5/7\n", on_slab ? "slab" : "plane", end.velocity[0].x * 7 / 5);
    EXPECT_NEAR(end.velocity[0].x * 7 / 5, 1, 1e-3);
    EXPECT_NEAR(end.angular_velocity[0].y * 0.01 * 7 / 5, 1, 1e-3);
  }
}

TEST(Sphere, GrossSlidingImpactsOfChungOoi) {
  // Test 4, Al alloy, e 0.98, mu 0.092: tangential restitution and spin where sliding lasts the whole contact.
  const double angles[] = {50, 60, 70, 80}, restitution[] = {0.8471496, 0.8948299, 0.9336992, 0.9678803};
  const double spin[] = {456.65174, 355.212, 242.97932, 123.36383};
  for (int i = 0; i < 4; ++i) {
    Scene scene = empty_scene(0.98, 0.092);
    scene.materials = {{"Al alloy", 2700, 70e9, 0.33}, {"rigid", 1, 1e30, 0}};
    scene.contact.assign(2, {{0.98, 0.092}, {0.98, 0.092}});
    scene.sphere_law = dem_gpu::Hertz{};
    scene.shapes = {dem_gpu::sphere_shape("ball", 0.0025)};
    scene.walls = {floor_wall()};
    scene.walls[0].material = 1;
    const double along = 3.9 * std::sin(angles[i] * kDegree), down = 3.9 * std::cos(angles[i] * kDegree);
    scene.bodies = {body_at(0, {0, 0, 0.0025001}, {}, {along, 0, -down})};
    scene.run.time_step = 1e-8;
    Simulation simulation(scene);
    run_impact(simulation);
    const auto after = simulation.snapshot();
    std::printf("  test 4 at %.0f degrees: tangential restitution %.5f (%.5f), spin %.2f (%.2f)\n", angles[i],
                after.velocity[0].x / along, restitution[i], after.angular_velocity[0].y, spin[i]);
    EXPECT_NEAR(after.velocity[0].x / along, restitution[i], 0.01 * restitution[i]);
    EXPECT_NEAR(after.angular_velocity[0].y, spin[i], 0.01 * spin[i]);
  }
}

TEST(Friction, OnlyDissipates) {
  // Grazing impacts of a cube and of a Hertz sphere, many angles: kinetic energy after is not above kinetic before.
  double largest_gain[2] = {0, 0};
  for (const bool sphere : {false, true})
    for (int degrees = 5; degrees < 90; degrees += 10) {
      Scene scene = empty_scene(1, 0.4);
      scene.materials[0].youngs_modulus = 1e8;
      scene.sphere_law = dem_gpu::Hertz{};
      scene.shapes = {sphere ? dem_gpu::sphere_shape("ball", 0.01) : box_shape({0.02, 0.02, 0.02})};
      scene.walls = {floor_wall()};
      const double angle = degrees * kDegree;
      const Quaternion tilt = dem_gpu::axis_angle({0.6, 0.8, 0}, 0.5);
      scene.bodies = {body_at(0, {0, 0, sphere ? 0.0101 : 0.018}, tilt, {std::sin(angle), 0, -std::cos(angle)})};
      scene.bodies[0].angular_velocity = {0, -30, 10};
      scene.run.steps_per_contact = 100;
      Simulation simulation(scene);
      run_impact(simulation);
      const auto ledger = simulation.ledger();
      const double gain = ledger.kinetic / ledger.initial - 1;
      largest_gain[sphere] = std::max(largest_gain[sphere], gain);
      EXPECT_LE(gain, 1e-4) << (sphere ? "sphere" : "cube") << " at " << degrees;
      EXPECT_LT(std::abs(ledger.imbalance()), 2e-3 * ledger.initial);
    }
  std::printf("  largest gain of kinetic energy in a grazing impact: cube %.1e, Hertz sphere %.1e\n", largest_gain[0],
              largest_gain[1]);
}

}  // namespace
