// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dem_gpu/core/pass.h"

namespace dem_gpu {

/// First half kick and drift of velocity Verlet; velocities that contacts see.
std::unique_ptr<Pass> make_advance_bodies_pass();
/// Prescribed motion of the walls to the end of the step.
std::unique_ptr<Pass> make_advance_walls_pass();
/// Sums contacts over each body, adds gravity, second half kick.
std::unique_ptr<Pass> make_gather_forces_pass();
/// Takes bodies below the outflow out of the simulation.
std::unique_ptr<Pass> make_outflow_pass();

}  // namespace dem_gpu
