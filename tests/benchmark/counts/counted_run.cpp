// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/counts/counted_run.h"

#include <valgrind/callgrind.h>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"

namespace benchmark_counts {
namespace {

namespace fs = std::filesystem;
using benchmark_scenes::Law;

fs::path snapshot_file(const fs::path& folder, const CountedRun& run) {
  return folder / (run.scene + "_" + std::to_string(run.bodies) + ".h5");
}

}  // namespace

const std::vector<CountedRun>& guard_runs() {
  static const std::vector<CountedRun> runs{{"s1-small", "s1-box", Law::depth_potential, 1000, 150},
                                            {"s2-small-volume", "s2", Law::overlap_volume, 100, 100},
                                            {"s2-small-depth", "s2", Law::depth_potential, 100, 100}};
  return runs;
}

const std::vector<CountedRun>& whole_runs() {
  static const std::vector<CountedRun> runs{{"s1-box", "s1-box", Law::depth_potential, 10000, 100},
                                            {"s2-volume", "s2", Law::overlap_volume, 1000, 50},
                                            {"s2-depth", "s2", Law::depth_potential, 1000, 50}};
  return runs;
}

const CountedRun& counted_run(const std::string& name) {
  std::vector<std::string> known;
  for (const auto* runs : {&guard_runs(), &whole_runs()})
    for (const CountedRun& run : *runs) {
      if (run.name == name) return run;
      known.push_back(run.name);
    }
  throw catalog::UsageError("no counted run '" + name + "'; " + catalog::word_hint(name, known));
}

void settle_into(const fs::path& folder, const CountedRun& run) {
  const fs::path file = snapshot_file(folder, run);
  if (fs::exists(file)) return;
  dem_gpu::write_snapshot(file, benchmark_scenes::settle(benchmark_scenes::speed_scene(run.scene), run.bodies).settled);
}

void step_counted(const fs::path& folder, const CountedRun& run) {
  benchmark_scenes::SceneOptions options;
  options.law = run.law;
  options.bodies = run.bodies;
  dem_gpu::Simulation simulation(benchmark_scenes::resumed(benchmark_scenes::speed_scene(run.scene).make(options),
                                                           dem_gpu::read_snapshot(snapshot_file(folder, run))));
  simulation.advance(kWarmUpSteps);
  CALLGRIND_START_INSTRUMENTATION;
  simulation.advance(run.steps);
  CALLGRIND_STOP_INSTRUMENTATION;
}

}  // namespace benchmark_counts
