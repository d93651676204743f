// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/pass.h"

namespace dem_gpu {

/// Depth fields take long to make.
PreparedShapes prepare_shapes(const Scene& scene);

/// `shapes`: of the scene, or of another with the same shapes and the objects among its walls. `at_start`: filled with
/// the bodies at time 0.
Model make_model(const Scene& scene, PreparedShapes shapes, BodyColumns& at_start);

/// The state at time 0, contacts and forces not yet found.
State start_state(const Model& model, BodyColumns at_start);

/// Contacts and forces at the present time, as a step of no length: the first half kick needs them.
void find_forces(const std::vector<std::unique_ptr<Pass>>& passes, Model& model, State& state);

}  // namespace dem_gpu
