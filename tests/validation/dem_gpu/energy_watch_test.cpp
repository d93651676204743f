// SPDX-License-Identifier: Apache-2.0
// A run that makes energy from nothing stops by name; one into which walls put a lot of work does not.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;

TEST(EnergyFromNothing, StopsWithStepBodyPartnerAndRemedy) {
  // Nineteen floors in one place and nineteen ceilings push 38 times as hard as the step was chosen for: at 5 steps a
  // contact Verlet's limit, w step < 2, is broken (2.7), and the shiver of a cube between them grows without bound.
  Scene scene = empty_scene(1, 0);
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  constexpr Real kSunk = 1e-4, kOff = 1e-6;  // into each, and off the middle [m]
  scene.bodies = {body_at(0, {0.5, 0, kEdge / 2 - kSunk}), body_at(0, {0, 0, kEdge / 2 - kSunk + kOff})};
  scene.bodies[0].is_fixed = true;
  for (int i = 0; i < 19; ++i) {
    scene.walls.push_back(floor_wall("floor " + std::to_string(i)));
    scene.walls.push_back(floor_wall("ceiling " + std::to_string(i)));
    scene.walls.back().geometry = dem_gpu::Plane{{0, 0, kEdge - 2 * kSunk}, {0, 0, -1}};
  }
  scene.run.steps_per_contact = 5;
  Simulation simulation(scene);
  std::string message = "went on";
  try {
    simulation.advance(200000);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  std::printf("  %s\n", message.c_str());
  const std::string step = "step " + std::to_string(simulation.step()) + ", time ";
  for (const std::string& part :
       {step, std::string("J of kinetic energy came from nothing"), std::string("body 1 is the fastest"),
        std::string("its deepest contact is with wall '"), std::string("shorter time step or more steps")})
    EXPECT_NE(message.find(part), std::string::npos) << part;
}

TEST(EnergyFromNothing, IsNotABallBackAtItsApex) {
  // Gravity has taken back there nearly all it put in: rounding is a large share of what is left, not of the fall.
  Scene scene = empty_scene(1, 0);
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.005)};
  scene.bodies = {body_at(0, {0, 0, 0.03})};
  scene.walls = {floor_wall()};
  Simulation simulation(scene);
  double throughput = 0, imbalance = 0;
  while (simulation.time() < 0.5) {
    ASSERT_NO_THROW(simulation.advance(200));
    const dem_gpu::EnergyLedger ledger = simulation.ledger();
    EXPECT_GE(ledger.throughput, 0.5 * throughput);  // does not fall back with the ball; half: between two listings
    throughput = std::max(throughput, ledger.throughput);
    imbalance = std::max(imbalance, std::abs(ledger.imbalance()));
  }
  const Real mass = scene.materials[0].density * scene.shapes[0].volume;
  EXPECT_NEAR(throughput, mass * 9.81 * 0.025, 0.1 * throughput);
  EXPECT_LT(imbalance, 1e-3 * throughput);
}

TEST(EnergyFromNothing, IsNotWorkOfMovingWalls) {
  // Elastic grains on a floor that shakes at 100 g, under a bar that beats through them: all they have is the walls'
  // work, hundreds of times what they began with, and no dissipation takes it away.
  Scene scene = empty_scene(1, 0);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e10};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge}), dem_gpu::sphere_shape("ball", kEdge / 2)};
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      scene.bodies.push_back(body_at((x + y) % 2, {0.03 + 0.045 * x, 0.03 + 0.045 * y, 0.015}));
  scene.walls = room({0.15, 0.15, 0.2});
  scene.walls[4].motion.amplitude = {0, 0, 0.001};
  scene.walls[4].motion.frequency = 150;
  dem_gpu::Wall bar;
  bar.name = "bar";
  bar.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.1, 0.02, 0.02}), {}, {0.075, 0.075, 0.1})};
  bar.motion.rotation_centre = {0.075, 0.075, 0.1};
  bar.motion.angular_velocity = {0, 0, 2 * std::numbers::pi * 5};
  scene.walls.push_back(bar);
  Simulation simulation(scene);
  EXPECT_NO_THROW(simulation.advance(40000));
  const auto ledger = simulation.ledger();
  const double fall = 9 * 2500 * kEdge * kEdge * kEdge * 9.81 * 0.005;  // all the grains could have without the walls
  std::printf("  shaken for %.2f s: work of the walls %.3f J, kinetic energy %.3f J, energy off by %.1e of the work\n",
              simulation.time(), ledger.wall_work, ledger.kinetic, ledger.imbalance() / ledger.wall_work);
  EXPECT_GT(ledger.kinetic, 20 * fall);
  EXPECT_LT(std::abs(ledger.imbalance()), 0.02 * ledger.wall_work);
}

}  // namespace
