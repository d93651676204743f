// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/speed/settled_scene.h"

#include <cmath>
#include <map>

#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/resumed_scene.h"

namespace workflows {
namespace {

using benchmark_scenes::SceneOptions;
using benchmark_scenes::SpeedScene;

constexpr double kSettlingOverlap = 0.05;  // flat, see SceneOptions
constexpr double kSettlingSteps = 10;      // in the stiffest contact

struct Settled {
  dem_gpu::Snapshot busy, settled;
};

void advance_to(dem_gpu::Simulation& simulation, double time) {
  simulation.advance(std::llround(time / simulation.time_step()) - simulation.step());
}

Settled settle(const SpeedScene& speed_scene) {
  SceneOptions options;
  if (speed_scene.has_polyhedra) {
    options.law = benchmark_scenes::Law::overlap_volume;
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

const Settled& settled_once(const SpeedScene& speed_scene) {
  static std::map<std::string, Settled> known;
  const auto found = known.find(speed_scene.name);
  return found != known.end() ? found->second : known.emplace(speed_scene.name, settle(speed_scene)).first->second;
}

}  // namespace

dem_gpu::Scene scene_at(const SpeedScene& speed_scene, Moment moment, const SceneOptions& options) {
  const Settled& settled = settled_once(speed_scene);
  return benchmark_scenes::resumed(speed_scene.make(options), moment == Moment::busy ? settled.busy : settled.settled);
}

}  // namespace workflows
