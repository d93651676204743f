// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/restitution_damping.h"

#include <algorithm>

namespace dem_gpu {
namespace {

/// 2 s cot(s), s = acos(ratio); 2 s coth(s), s = acosh(ratio), beyond 1.
Real loss_exponent(Real ratio) {
  if (ratio < 1) {
    const Real s = std::acos(ratio);
    return 2 * s / std::tan(s);
  }
  const Real s = std::acosh(ratio);
  return s > 0 ? 2 * s / std::tanh(s) : 2;
}

}  // namespace

Real damping_ratio(Real restitution) {
  if (restitution >= 1) return 0;
  const Real loss = -std::log(std::max(restitution, kLeastRestitution));
  Real low = 0, high = 1 / kLeastRestitution;
  for (int bisection = 0; bisection < 80; ++bisection) {
    const Real middle = (low + high) / 2;
    (loss_exponent(middle) < loss ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace dem_gpu
