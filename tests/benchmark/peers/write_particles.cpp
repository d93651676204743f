// SPDX-License-Identifier: Apache-2.0
// Where the bodies of a scene begin, or lie once they have settled, as its peers read it
// (tests/benchmark/scenes/peer_files.h).
#include <cstdio>
#include <stdexcept>
#include <string>

#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/peer_files.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"

namespace {

/// Settled, and then by the law and stiffness of the timed scene, the volume law of polyhedra, for as many steps as
/// time_scene --settled goes before its windows: settling is softer, and its bodies reach deeper into one another.
dem_gpu::Scene settled_scene(const benchmark_scenes::SpeedScene& chosen) {
  benchmark_scenes::SceneOptions options;
  if (chosen.has_polyhedra) options.law = benchmark_scenes::Law::overlap_volume;
  const dem_gpu::Scene scene = chosen.make(options);
  dem_gpu::Simulation simulation(benchmark_scenes::resumed(scene, benchmark_scenes::settle(chosen).settled));
  simulation.advance(benchmark_scenes::kResettlingSteps);
  return benchmark_scenes::resumed(scene, simulation.snapshot());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string format = argc > 2 ? argv[2] : "", moment = argc > 3 ? argv[3] : "start";
  if (argc > 4 || (format != "lammps" && format != "table") || (moment != "start" && moment != "settled")) {
    std::fprintf(stderr, "usage: write_particles SCENE lammps|table [start|settled] > FILE\n");
    return 2;
  }
  try {
    const benchmark_scenes::SpeedScene& chosen = benchmark_scenes::speed_scene(argv[1]);
    const dem_gpu::Scene scene = moment == "settled" ? settled_scene(chosen) : chosen.make({});
    const std::string text =
        format == "lammps" ? benchmark_scenes::lammps_particles(scene) : benchmark_scenes::particle_table(scene);
    std::fputs(text.c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_particles: %s\n", error.what());
    return 2;
  }
  return 0;
}
