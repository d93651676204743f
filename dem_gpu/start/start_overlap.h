// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

/// Refuses a start in which bodies overlap each other or a wall by more than scene.run.largest_start_overlap: throws
/// catalog::InputError naming both, the overlap and the remedy. `state`: contacts found at time 0.
void refuse_deep_start(const Model& model, const State& state);

/// Refuses walls that move so far in a step that they could pass through a body: more than kTravelShare of the thinnest
/// body's least width. Throws catalog::InputError.
void refuse_fast_walls(const Model& model, const State& state);

/// Elastic energy of the contacts that overlap at time 0: the work of drawing each pair apart, with all else away, by
/// quadrature of the scene's own law [J]. Books it contact by contact as stored, and returns the sum.
Real book_start_energy(const Model& model, State& state);

}  // namespace dem_gpu
