// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

/// Keys of all pairs that may touch before a body or a wall has moved half the skin, ascending.
DeviceVector<ContactKey> candidate_keys(const Model& model, State& state);

}  // namespace dem_gpu
