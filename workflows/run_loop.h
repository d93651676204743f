// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dem_gpu/simulation.h"
#include "workflows/run_folder.h"
#include "workflows/run_schedule.h"
#include "workflows/scene_assembly.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// Everything a run needs to be carried on from where `simulation` stands.
struct RunPlan {
  const SceneDescription& description;
  const AssembledScene& assembled;
  const RunFolder& folder;
  std::string command;              // as typed
  double earlier_wall_seconds = 0;  // of the runs that this one resumes
};

/// Refuses outputs more often than every step.
RunSchedule run_schedule(const SceneDescription& description, const dem_gpu::Scene& scene);

/// Makes TERM, USR1 and INT ask for a stop instead of ending the process.
void catch_stop_signals();

/// Advances to the end, writing snapshots, series, checkpoints and run.json, with progress on stderr.
/// Yields kDone, or kResumable or kInterrupted after a signal, with a checkpoint written.
ExitStatus run_to_end(dem_gpu::Simulation& simulation, const RunPlan& plan, bool is_resumed);

}  // namespace workflows
