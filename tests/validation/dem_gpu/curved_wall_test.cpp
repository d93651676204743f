// SPDX-License-Identifier: Apache-2.0
// Curved walls in motion: a block that rattles in a resting drum keeps its energy; a drum of flat segments stands in
// for a round one as nearly as its sagitta says.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/support/dem_runs.h"
#include "tests/support/wall_meshes.h"

namespace {

using namespace test_support;

constexpr Real kEdge = 0.02;  // of the block [m]

/// Energy gained or lost by an elastic block that slides and rattles in a cylinder, over m g R / 2.
double energy_error(double radius_over_edge) {
  const Real radius = radius_over_edge * kEdge;
  dem_gpu::Scene scene = empty_scene(1, 0);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  dem_gpu::Wall shell;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -1, 0}, {0, 1, 0}, 2, radius};
  scene.walls = {shell};
  scene.bodies = {body_at(0, {radius / 3, 0, -radius / 2}, dem_gpu::axis_angle({0, 0.8, 0.6}, 0.3))};
  dem_gpu::Simulation simulation(scene);
  run_to(simulation, 0.5);
  return simulation.ledger().imbalance() / (2500 * 8e-6 * 9.81 * radius / 2);
}

TEST(CurvedWall, AnElasticBlockKeepsItsEnergy) {
  for (const double ratio : {5.0, 20.0, 50.0}) {
    const double error = energy_error(ratio);
    std::printf("  elastic block in a drum of %.0f edges radius: energy error %.1e of m g R / 2 in 0.5 s\n", ratio,
                error);
    // Second order in the step: some (1 / 20 of a contact)^2 of what is stored, which is a hundredth of the energy.
    EXPECT_LT(std::abs(error), 3e-5);
  }
}

constexpr Real kRadius = 0.1, kLength = 0.06;  // of the drum [m]
constexpr Real kTurnRate = 1;                  // [rad/s]
constexpr Real kFriction = 0.3;

/// A block dragged up a slowly turning drum until it slides. `segments` of equal area of section; 0: a cylinder.
dem_gpu::Scene dragged_block(int segments) {
  dem_gpu::Scene scene = empty_scene(0.3, kFriction);
  scene.polyhedral_law = dem_gpu::DepthPotential{5e8};
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  const Real start = -std::sqrt(kRadius * kRadius - kEdge * kEdge / 4) + kEdge / 2;
  scene.bodies = {body_at(0, {0, kLength / 2, start}, {})};
  dem_gpu::Wall shell;
  if (segments > 0) {
    const Real turn = 2 * std::numbers::pi / segments, equal_area = std::sqrt(turn / std::sin(turn));
    shell = mesh_wall("shell", drum_mesh(kRadius * equal_area, kLength, segments));
    std::get<dem_gpu::MeshObject>(shell.geometry).is_container = true;
  } else {
    shell.name = "shell";
    shell.geometry = dem_gpu::Cylinder{{0, 0, 0}, {0, 1, 0}, kLength, kRadius};
  }
  shell.motion.angular_velocity = {0, kTurnRate, 0};
  shell.motion.ramp_time = 0.05;
  scene.walls = {shell};
  scene.run.time_step = 4e-5;
  return scene;
}

struct DrumRun {
  std::vector<Vec3> position;  // every 2 ms [m]
  std::vector<double> energy;  // kinetic and gravitational [J]
  double torque = 0;           // on the shell about its axis, mean while the block slides [N m]
  double work = 0;             // of the shell [J]
};

DrumRun run_drum(int segments) {
  dem_gpu::Simulation simulation(dragged_block(segments));
  DrumRun run;
  for (int i = 0; i < 500; ++i) {
    if (i == 350) simulation.take_wall_loads();
    simulation.advance(50);
    run.position.push_back(simulation.snapshot().position[0]);
    const auto ledger = simulation.ledger();
    run.energy.push_back(ledger.kinetic + ledger.gravitational);
  }
  const auto load = simulation.take_wall_loads()[0];
  run.torque = load.torque.y;
  run.work = load.work;
  return run;
}

TEST(CurvedWall, FlatSegmentsStandInForACylinder) {
  const DrumRun round = run_drum(0);
  const Real weight = 2500 * kEdge * kEdge * kEdge * 9.81;
  std::printf("  segments  sagitta/R  radial   along the wall  energy/mgR  torque  (differences from the cylinder)\n");
  for (const int segments : {64, 512}) {
    const DrumRun flat = run_drum(segments);
    const Real half_turn = std::numbers::pi / segments, sagitta = 1 - std::cos(half_turn);
    Real radial = 0, along = 0, energy = 0;
    for (std::size_t i = 0; i < round.position.size(); ++i) {
      const Vec3 &a = round.position[i], &b = flat.position[i];
      radial = std::max(radial, std::abs(std::hypot(a.x, a.z) - std::hypot(b.x, b.z)) / kRadius);
      along = std::max(along, std::abs(std::atan2(a.x, -a.z) - std::atan2(b.x, -b.z)));
      energy = std::max(energy, std::abs(round.energy[i] - flat.energy[i]) / (weight * kRadius));
    }
    const Real torque = std::abs(flat.torque / round.torque - 1);
    ASSERT_GT(round.energy.back() - round.energy.front(), 0.01 * weight * kRadius) << "dragged up";
    std::printf("  %8d  %9.1e  %.1e  %.1e rad     %.1e     %.1e\n", segments, sagitta, radial, along, energy, torque);
    // Segments of equal area lie a third of the sagitta within the cylinder and two thirds without.
    EXPECT_LT(radial, sagitta);
    // A segment leans by up to half its turn against the cylinder. A block that slides where the slope is its angle of
    // friction is off by as much, to either side; its height by the sine of that angle (18 degrees with the swing) as
    // much.
    EXPECT_LT(along, 2 * half_turn);
    EXPECT_LT(energy, 2 * half_turn * 0.4);
    // The mean over many segments is off by the lean alone.
    EXPECT_LT(torque, half_turn);
    EXPECT_LT(std::abs(flat.work / round.work - 1), half_turn);
  }
}

}  // namespace
