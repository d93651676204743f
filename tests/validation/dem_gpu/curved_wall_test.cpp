// SPDX-License-Identifier: Apache-2.0
// How far the contact with a curved wall is from a gradient: a block sliding round in a resting drum, frictionless.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;

/// Energy gained or lost by an elastic block that slides and rattles in a cylinder, over m g R / 2.
double energy_error(double radius_over_edge) {
  const Real edge = 0.02, radius = radius_over_edge * edge;
  dem_gpu::Scene scene = empty_scene(1, 0);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({edge, edge, edge})};
  dem_gpu::Wall shell;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -1, 0}, {0, 1, 0}, 2, radius};
  scene.walls = {shell};
  scene.bodies = {body_at(0, {radius / 3, 0, -radius / 2}, dem_gpu::axis_angle({0, 0.8, 0.6}, 0.3))};
  dem_gpu::Simulation simulation(scene);
  run_to(simulation, 0.5);
  return simulation.ledger().imbalance() / (2500 * 8e-6 * 9.81 * radius / 2);
}

TEST(CurvedWall, EnergyErrorIsReported) {
  for (const double ratio : {5.0, 20.0, 50.0}) {
    const double error = energy_error(ratio);
    std::printf("  elastic block in a drum of %.0f edges radius: energy error %.1e of m g R / 2 in 0.5 s\n", ratio,
                error);
    EXPECT_LT(std::abs(error), 0.05);
  }
}

}  // namespace
