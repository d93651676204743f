// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "catalog/input_error.h"
#include "dem_gpu/simulation.h"
#include "workflows/scene_assembly.h"

namespace workflows {

/// dem_gpu::check; what it refuses begins with the place in the scene file that it belongs to: that of the wall, fill
/// or section, or the file alone.
void check_scene(const AssembledScene& assembled, const SceneDescription& description);

/// The simulation at time 0; what the engine refuses only then (bodies that overlap, walls too fast for the step)
/// begins with its place in the same way.
dem_gpu::Simulation start_simulation(const AssembledScene& assembled, const SceneDescription& description);

/// Runs `call`; what it refuses begins with `place`.
template <class Call>
auto at_place(const std::string& place, const Call& call) {
  try {
    return call();
  } catch (const catalog::InputError& error) {
    const std::string what = error.what();
    if (what.starts_with(place)) throw;
    throw catalog::InputError(place + ": " + what);
  }
}

}  // namespace workflows
