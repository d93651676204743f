// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

/// Hertz contact of elastic spheres: F = 4/3 E* sqrt(R*) overlap^(3/2). K.L. Johnson, Contact Mechanics (1985),
/// eq. 4.23.
struct Hertz {
  template <class Number>
  TALUS_HD Number normal_force(const Number& overlap, const Number& effective_radius,
                               const Number& effective_modulus) const {
    return Real(4) / 3 * effective_modulus * square_root(effective_radius * overlap) * overlap;
  }
  template <class Number>
  TALUS_HD Number tangent_stiffness(const Number& overlap, const Number& effective_radius,
                                    const Number& effective_modulus) const {
    return Real(2) * effective_modulus * square_root(effective_radius * overlap);
  }
  static constexpr Real kExponent = Real(1.5);
  static constexpr bool kIsAdhesive = false;
};

}  // namespace dem_gpu
