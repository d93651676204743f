// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

/// Linear spring between spheres, and of a sphere with anything. Cundall & Strack, Geotechnique 29 (1979) 47-65.
struct LinearSpring {
  Real stiffness = 0;  // k_n [N/m]

  template <class Number>
  TALUS_HD Number normal_force(const Number& overlap, const Number& /*effective_radius*/,
                               const Number& /*effective_modulus*/) const {
    return stiffness * overlap;
  }
  /// dF/d(overlap) [N/m]
  template <class Number>
  TALUS_HD Number tangent_stiffness(const Number& /*overlap*/, const Number& /*effective_radius*/,
                                    const Number& /*effective_modulus*/) const {
    return Number{} + stiffness;
  }
  static constexpr Real kExponent = 1;  // F ~ overlap^n
  static constexpr bool kIsAdhesive = false;
};

}  // namespace dem_gpu
