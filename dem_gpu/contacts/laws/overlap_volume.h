// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Published volume law: F = k V n at the centroid of the overlap, n along the vector area S of the contact.
/// Govender et al., Miner. Eng. 129 (2018); Elias, Powder Technol. 264 (2014) 458. Not the gradient of an energy: kept
/// for comparison with the literature.
struct OverlapVolume {
  Real stiffness = 0;  // k [N/m3]

  /// Of two flat faces [N/m3].
  TALUS_HD Real stiffness_per_area() const { return stiffness; }
};

}  // namespace dem_gpu
