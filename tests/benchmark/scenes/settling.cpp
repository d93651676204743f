// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/settling.h"

#include <cmath>

#include "dem_gpu/simulation.h"

namespace benchmark_scenes {
namespace {

constexpr double kSettlingOverlap = 0.05;  // flat, see SceneOptions
constexpr double kSettlingSteps = 10;      // in the stiffest contact

void advance_to(dem_gpu::Simulation& simulation, double time) {
  simulation.advance(std::llround(time / simulation.time_step()) - simulation.step());
}

}  // namespace

Settled settle(const SpeedScene& speed_scene, int bodies) {
  SceneOptions options;
  options.bodies = bodies;
  if (speed_scene.has_polyhedra) {
    options.law = Law::overlap_volume;
    options.flat_overlap = kSettlingOverlap;
    options.steps_per_contact = kSettlingSteps;
  }
  dem_gpu::Simulation simulation(speed_scene.make(options));
  Settled result;
  advance_to(simulation, speed_scene.busy_time);
  result.busy = simulation.snapshot();
  advance_to(simulation, speed_scene.settling_time);
  result.settled = simulation.snapshot();
  return result;
}

}  // namespace benchmark_scenes
