// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/speed/settled_scene.h"

#include <map>
#include <utility>

#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"
#include "workflows/bench/speed/step_time.h"

namespace workflows {

using benchmark_scenes::Settled;
using benchmark_scenes::SpeedScene;

namespace {

Settled settle_quickly(const SpeedScene& speed_scene, int bodies) {
  Settled settled;
  on_all_threads([&] { settled = benchmark_scenes::settle(speed_scene, bodies); });
  return settled;
}

const Settled& settled_once(const SpeedScene& speed_scene, int bodies) {
  static std::map<std::pair<std::string, int>, Settled> known;
  const std::pair<std::string, int> key{speed_scene.name, bodies};
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, settle_quickly(speed_scene, bodies)).first->second;
}

}  // namespace

dem_gpu::Scene scene_at(const SpeedScene& speed_scene, Moment moment, const benchmark_scenes::SceneOptions& options) {
  const Settled& settled = settled_once(speed_scene, options.bodies);
  return benchmark_scenes::resumed(speed_scene.make(options), moment == Moment::busy ? settled.busy : settled.settled);
}

}  // namespace workflows
