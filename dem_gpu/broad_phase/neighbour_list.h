// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/pass.h"

namespace dem_gpu {

/// Builds the table of candidate pairs anew when a body or a wall has moved half the skin since the last time. Pairs
/// that stay keep their history, found by key. Also finds bodies that have gone wrong.
std::unique_ptr<Pass> make_neighbour_list_pass();

/// Builds the table for the bodies' listed positions; used by the pass and after reading a checkpoint.
void build_neighbour_list(const Model& model, State& state);

}  // namespace dem_gpu
