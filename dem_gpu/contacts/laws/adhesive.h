// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// A sphere law with the constant attraction 2 pi w R* while the spheres touch: Derjaguin, Muller & Toporov, J. Colloid
/// Interface Sci. 53 (1975) 314-326. Gradient of the energy -2 pi w R* overlap, which is zero at touch: no hysteresis.
/// The pull that parts the spheres is 2 pi w R*.
template <class Law>
struct Adhesive : Law {
  static constexpr bool kIsAdhesive = true;

  /// `work`: of adhesion, w [J/m2].
  template <class Number>
  TALUS_HD static Number attraction(const Number& work, const Number& effective_radius) {
    return 2 * std::numbers::pi_v<Real> * work * effective_radius;
  }
};

}  // namespace dem_gpu
