// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Damping ratios that give one coefficient of restitution for contacts F ~ depth^n, tabulated over n = 1, 1.5, 2, 2.5,
/// 3. With damping force c v, c = 2 ratio sqrt(m_eff dF/d(depth)), restitution does not depend on impact speed for any
/// n (after Tsuji et al., Powder Technol. 71 (1992) 239-250, eq. 11, there for n = 1.5).
struct DampingRatios {
  Real ratio[5] = {0, 0, 0, 0, 0};

  TALUS_HD Real at(Real exponent) const {
    const Real place = exponent <= 1 ? 0 : exponent >= 3 ? 4 : 2 * (exponent - 1);
    const int low = place >= 4 ? 3 : static_cast<int>(place);
    return ratio[low] + (place - low) * (ratio[low + 1] - ratio[low]);
  }
};

/// Solves for the ratios by integrating the normal impact; the total normal force is never attractive. `restitution` in
/// (0, 1].
DampingRatios damping_ratios(Real restitution);

/// The ratio for F ~ depth^exponent alone. `restitution` in [0, 1]; below kLeastRestitution, that is meant.
Real damping_ratio(Real exponent, Real restitution);
/// A dashpot never takes all: within this of zero.
inline constexpr Real kLeastRestitution = Real(5e-4);

/// Restitution of a normal impact with F ~ depth^n at a given damping ratio.
Real impact_restitution(Real exponent, Real damping_ratio);

}  // namespace dem_gpu
