// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Potential contact of polyhedra: energy U = k * integral over the overlap of (depth_A + depth_B) dV, depth = distance
/// below the own body's surface, capped. Force and torque are the exact gradient of U. Flat on flat: F = 2 k A d.
/// After Munjiza, The Combined Finite-Discrete Element Method (2004), chapter 2.
struct DepthPotential {
  Real stiffness = 0;           // k [N/m3]
  Real depth_cap = Real(0.15);  // depth beyond which the field stays constant / equivalent diameter of the body [-]

  /// Of two flat faces [N/m3].
  TALUS_HD Real stiffness_per_area() const { return 2 * stiffness; }
};

}  // namespace dem_gpu
