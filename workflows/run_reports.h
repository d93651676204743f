// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "dem_gpu/simulation.h"
#include "workflows/scene_assembly.h"

namespace workflows {

/// What run.json says beyond the simulation's own state.
struct RunFacts {
  bool finished = false;
  double wall_seconds = 0;
  std::string command;
  std::string error;  // why it failed; empty if it did not
};

/// run.json.
nlohmann::ordered_json run_summary(const AssembledScene& assembled, const SceneDescription& description,
                                   const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger,
                                   const RunFacts& facts);

/// Requested and realised sizes of the fills that state any, as lines for a person.
std::string size_table(const AssembledScene& assembled, const SceneDescription& description);

/// The scene in a few lines for a person: bodies, shapes, walls, stiffness, time step.
std::string scene_table(const AssembledScene& assembled);

}  // namespace workflows
