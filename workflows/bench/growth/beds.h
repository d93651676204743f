// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"
#include "tests/benchmark/scenes/speed_scenes.h"

namespace workflows {

// Beds of any size without settling each: a settled box, set side by side with itself.

/// A box of a scene whose bodies have settled, `across` x `across` boxes in one; walls of the whole.
struct BedOptions {
  std::string scene = "s1-box";
  benchmark_scenes::Law law = benchmark_scenes::Law::depth_potential;
  int across = 1;
};
/// Bodies of one of those boxes.
int bodies_of_a_box(const std::string& scene);

/// Each scene settles once in the life of the process. Bodies begin at rest.
dem_gpu::Scene bed(const BedOptions& options);

/// Cost of a bed, which rises as a block while it is measured, so that its contacts last and its lists wear out.
struct BedCost {
  double step_time = 0;     // of a particle in a step that lists nothing [ns]
  double listing_time = 0;  // of a particle when bodies are listed anew, besides [ns]
  double contacts = 0;      // as each particle sees them [-]
  double memory = 0;        // of a particle, allocated [bytes]
  /// With a listing every 100 steps, somewhat more often than a settled bed has it [ns].
  double particle_step() const { return step_time + listing_time / 100; }
};
BedCost cost_of(dem_gpu::Scene bed);

}  // namespace workflows
