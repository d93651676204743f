// SPDX-License-Identifier: Apache-2.0
// Where the bodies of a scene begin, as its peers read it (tests/benchmark/scenes/peer_files.h).
#include <cstdio>
#include <stdexcept>
#include <string>

#include "tests/benchmark/scenes/peer_files.h"
#include "tests/benchmark/scenes/speed_scenes.h"

int main(int argc, char** argv) {
  const std::string format = argc > 2 ? argv[2] : "";
  if (argc > 4 || (format != "lammps" && format != "table")) {
    std::fprintf(stderr, "usage: write_particles SCENE lammps|table [BODIES] > FILE\n");
    return 2;
  }
  try {
    benchmark_scenes::SceneOptions options;
    if (argc > 3) options.bodies = std::stoi(argv[3]);
    const dem_gpu::Scene scene = benchmark_scenes::speed_scene(argv[1]).make(options);
    const std::string text =
        format == "lammps" ? benchmark_scenes::lammps_particles(scene) : benchmark_scenes::particle_table(scene);
    std::fputs(text.c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_particles: %s\n", error.what());
    return 2;
  }
  return 0;
}
