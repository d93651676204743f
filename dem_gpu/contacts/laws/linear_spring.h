// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Linear spring between spheres, and of a sphere with anything. Cundall & Strack, Geotechnique 29 (1979) 47-65.
struct LinearSpring {
  Real stiffness = 0;  // k_n [N/m]

  TALUS_HD Real normal_force(Real overlap, Real /*effective_radius*/, Real /*effective_modulus*/) const {
    return stiffness * overlap;
  }
  /// dF/d(overlap) [N/m]
  TALUS_HD Real tangent_stiffness(Real /*overlap*/, Real /*effective_radius*/, Real /*effective_modulus*/) const {
    return stiffness;
  }
  static constexpr Real kExponent = 1;  // F ~ overlap^n
  static constexpr bool kIsAdhesive = false;
};

}  // namespace dem_gpu
