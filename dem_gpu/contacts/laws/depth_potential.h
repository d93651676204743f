// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Potential contact of polyhedra: energy U = k * integral over the overlap of (depth_A + depth_B) dV, depth = distance
/// below the own body's surface, capped (dem_gpu/shapes/surface_terms.h). Force and torque are the exact gradient of U.
/// Flat on flat: F = 2 k A d. An edge sinks in about 5 times, a corner 13 times as far as a face at the same impact.
/// After Munjiza, The Combined Finite-Discrete Element Method (2004), chapter 2.
struct DepthPotential {
  Real stiffness = 0;  // k [N/m3]
  /// Depth beyond which the field stays constant / equivalent diameter of the body [-]. The force saturates there: at
  /// k A cap a field. Flat cubes feel the default from 19 % of their edge on, and it keeps 84 % of the energy that
  /// holds them apart without a cap; caps of 0.02 to 0.25 cost the same, 0.5 a fifth more on a rough rock (bench laws,
  /// cases cap-*).
  Real depth_cap = Real(0.15);

  /// Of two flat faces, at touch [N/m3].
  TALUS_HD Real stiffness_per_area() const { return 2 * stiffness; }
};

}  // namespace dem_gpu
