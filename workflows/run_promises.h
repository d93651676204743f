// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem_gpu/simulation.h"
#include "workflows/scene_assembly.h"

namespace workflows {

/// One promise of the run's preset against what came of it.
struct PromiseKept {
  std::string figure;
  double value = 0, promised = 0;
  bool is_kept = false;
  const char* remedy = "";  // where it is broken
};
std::vector<PromiseKept> promises(const AssembledScene& assembled, const dem_gpu::Simulation& simulation,
                                  const dem_gpu::EnergyLedger& ledger);
/// The same as a line for the log.
std::string promise_line(const AssembledScene& assembled, const std::vector<PromiseKept>& kept);

/// What is wrong with a time step of the user's own before anything runs: fewer steps in the shortest contact than the
/// preset promises its accuracy for.
std::optional<std::string> start_warning(const dem_gpu::Scene& scene);

/// Things about the run so far that its owner should know; empty for a good one.
std::vector<std::string> run_warnings(const AssembledScene& assembled, const SceneDescription& description,
                                      const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger);

/// Imbalance over the energy put in [-]; 0 before any was.
double imbalance_share(const dem_gpu::EnergyLedger& ledger);

}  // namespace workflows
