// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/laws/depth_potential.h"
#include "dem_gpu/contacts/laws/overlap_volume.h"
#include "dem_gpu/core/host_device.h"

namespace dem_gpu {

/// Stiffness per area of a wall's field so that a flat face meets a wall as stiffly as another flat face.
TALUS_HD inline Real wall_stiffness(const DepthPotential& law) { return 2 * law.stiffness; }
/// F = k V n on a flat wall: the integral of the depth over the surface inside is the overlap volume.
TALUS_HD inline Real wall_stiffness(const OverlapVolume& law) { return law.stiffness; }

}  // namespace dem_gpu
