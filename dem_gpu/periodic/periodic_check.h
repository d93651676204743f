// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Refuses a periodic box that cannot be simulated: without a span, low >= high, so narrow that a body would meet two
/// images of another or its own, bodies outside it, an outflow along a periodic axis. And walls that would not act
/// alike on both sides of a face: planes that stand across a periodic axis, walls outside the box, and walls that
/// neither go past both faces nor keep clear of them over the whole run, or do and turn about another axis. Throws
/// catalog::InputError with the figures and the remedy.
void check_periodic(const Scene& scene);

}  // namespace dem_gpu
