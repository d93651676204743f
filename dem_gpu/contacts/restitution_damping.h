// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

// A dashpot that gives one coefficient of restitution whatever the elastic law and the impact speed. With the stored
// energy U(depth) and F = dU/d(depth), the damping force c v, c = 2 z sqrt(m_eff) F / sqrt(2 U), makes of the impact a
// linear oscillator of damping ratio z, in the place sqrt(2 U) and a time that runs as d sqrt(2 U)/d(depth). (For
// Hertz: Antypov & Elliott, Europhys. Lett. 94 (2011) 50004.) The impact ends where elastic and damping force together
// are zero: they never pull.

/// z for a coefficient of restitution in [0, 1]; below kLeastRestitution, that is meant. With z = cos(s) restitution is
/// exp(-2 s cot(s)), with z = cosh(s) it is exp(-2 s coth(s)) (Schwager & Poeschel, Granular Matter 9 (2007) 465-469,
/// rewritten).
Real damping_ratio(Real restitution);
/// A dashpot never takes all: within this of zero.
inline constexpr Real kLeastRestitution = Real(5e-4);

/// F^2 / (2 U) of a power law F ~ depth^n: the mean of tangent and secant stiffness [N/m].
template <class Number>
TALUS_HD Number damped_stiffness(const Number& tangent, const Number& secant) {
  return (tangent + secant) / 2;
}

/// c of a dashpot [N s/m]. `stiffness`: damped_stiffness.
template <class Number>
TALUS_HD Number dashpot(const Number& damping_ratio, const std::type_identity_t<Number>& effective_mass,
                        const std::type_identity_t<Number>& stiffness) {
  return 2 * damping_ratio * square_root(effective_mass * stiffness);
}

}  // namespace dem_gpu
