// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dem_gpu/simulation.h"
#include "workflows/scene_assembly.h"

namespace workflows {

/// resolved_scene.json: the scene as understood, in SI, with everything worked out. `scene_folder` is where relative
/// paths of the scene file start, kept for a resumed run.
nlohmann::ordered_json resolved_scene(const AssembledScene& assembled, const SceneDescription& description,
                                      const std::string& scene_folder);

/// What run.json says beyond the simulation's own state.
struct RunFacts {
  bool finished = false;
  double wall_seconds = 0;
  std::string command;
  std::string error;  // why it failed; empty if it did not
};

/// One promise of the run's preset against what came of it.
struct PromiseKept {
  std::string figure;
  double value = 0, promised = 0;
  bool is_kept = false;
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

/// run.json.
nlohmann::ordered_json run_summary(const AssembledScene& assembled, const SceneDescription& description,
                                   const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger,
                                   const RunFacts& facts);

/// Requested and realised sizes of the fills that state any, as lines for a person.
std::string size_table(const AssembledScene& assembled, const SceneDescription& description);

/// The scene in a few lines for a person: bodies, shapes, walls, stiffness, time step.
std::string scene_table(const AssembledScene& assembled);

/// Imbalance over the energy put in [-]; 0 before any was.
double imbalance_share(const dem_gpu::EnergyLedger& ledger);

}  // namespace workflows
