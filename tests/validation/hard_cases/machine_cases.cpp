// SPDX-License-Identifier: Apache-2.0
// Grains in machines.
#include <cmath>
#include <stdexcept>

#include "tests/support/dem_runs.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

/// A cube of 20 mm lies before a lifter that turns, and behind it a block that stands, 12 mm clear of one another: it
/// is squeezed out or crushed, with an endless force behind it.
Finding wedged_grain() {
  Scene scene = empty_scene(0.3, 0.5);
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({0.02, 0.02, 0.02})};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  dem_gpu::Wall shell, lifter, block, front, back;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -0.05, 0}, {0, 1, 0}, 0.1, 0.1};
  lifter.name = "lifter";
  lifter.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.1, 0.032}), {}, {-0.05, 0, -0.072})};
  lifter.motion.angular_velocity = {0, -2, 0};
  block.name = "block";
  block.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.03, 0.1, 0.03}), {}, {0.05, 0, -0.09})};
  front.name = "front";
  front.geometry = dem_gpu::Plane{{0, -0.05, 0}, {0, 1, 0}};
  back.name = "back";
  back.geometry = dem_gpu::Plane{{0, 0.05, 0}, {0, -1, 0}};
  scene.walls = {shell, lifter, block, front, back};
  scene.bodies = {body_at(0, {0.0, 0, -0.088})};
  try {
    Simulation simulation(scene);
    run_to(simulation, 1.5);
    const auto ledger = simulation.ledger();
    const double share = std::abs(ledger.imbalance()) / ledger.throughput;
    const Vec3 x = simulation.snapshot().position[0];
    return {share < 0.01 && simulation.quality().largest_overlap < 0.5 && std::hypot(x.x, x.z) < 0.1 &&
                std::abs(x.y) < 0.05,
            text("ends inside, energy off by %.1e, largest overlap %.2g of the diameter", share,
                 simulation.quality().largest_overlap)};
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    return {message.find("body 0") != std::string::npos && message.find("step ") == 0, "\"" + message + "\""};
  }
}

/// A pendulum of two bodies in a corner between a moving and a standing wall: pressed on by a wall that closes in.
Finding closing_walls() {
  Scene scene = empty_scene(0.5, 0.3);
  scene.gravity = {};
  scene.shapes = {box_shape({0.02, 0.02, 0.02})};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.walls = {floor_wall(), floor_wall("press")};
  scene.walls[1].geometry = dem_gpu::Plane{{0, 0, 0.0401}, {0, 0, -1}};
  scene.walls[1].motion.velocity = {0, 0, -0.002};
  scene.bodies = {body_at(0, {0, 0, 0.01}), body_at(0, {0.002, 0.001, 0.03})};
  Simulation simulation(scene);
  run_to(simulation, 0.25);
  const auto ledger = simulation.ledger();
  // 0.4 mm of travel shared by three faces in a row: each the face area but for the offset of the two cubes.
  const double share = std::abs(ledger.imbalance()) / ledger.throughput;
  return {share < 1e-3 && ledger.elastic_normal > 0.5 * ledger.wall_work,
          text("work of the press %.4g J, stored %.4g J, energy off by %.1e", ledger.wall_work, ledger.elastic_normal,
               share)};
}

}  // namespace

std::vector<HardCase> machine_cases() {
  return {{"grain wedged between lifter and block in a shell",
           "ends inside, uncrushed, energy to 1 %; or stops by name", true, wedged_grain},
          {"two cubes in a press", "work of the press stored, energy to 1e-3", true, closing_walls}};
}

}  // namespace hard_cases
