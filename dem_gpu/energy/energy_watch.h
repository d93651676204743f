// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

/// "step 12, time 3e-4 s: ", for messages.
std::string step_place(const Model& model, const State& state);

/// Stops a run that makes energy: throws std::runtime_error naming step, body and remedy if the ledger shows kinetic
/// energy out of nothing. Keeps the largest throughput seen. Does nothing where the scene keeps no ledger.
void watch_energy(const Model& model, State& state);

/// Stops a run in which two have been pushed through one another: a depth beyond the smaller body's whole diameter
/// since the accounts were last collected. Throws std::runtime_error naming step, both and remedy.
void refuse_pushed_through(const Model& model, const State& state);

}  // namespace dem_gpu
