// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Hertz contact of elastic spheres: F = 4/3 E* sqrt(R*) overlap^(3/2). K.L. Johnson, Contact Mechanics (1985),
/// eq. 4.23.
struct Hertz {
  TALUS_HD Real normal_force(Real overlap, Real effective_radius, Real effective_modulus) const {
    return Real(4) / 3 * effective_modulus * std::sqrt(effective_radius * overlap) * overlap;
  }
  TALUS_HD Real tangent_stiffness(Real overlap, Real effective_radius, Real effective_modulus) const {
    return 2 * effective_modulus * std::sqrt(effective_radius * overlap);
  }
  static constexpr Real kExponent = Real(1.5);
  static constexpr bool kIsAdhesive = false;
};

}  // namespace dem_gpu
