// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/restitution_damping.h"

#include <algorithm>
#include <cmath>

namespace dem_gpu {

Real impact_restitution(Real exponent, Real damping_ratio) {
  // Mass, stiffness and impact speed are 1: d'' = -(d^n + c d'), c = 2 ratio sqrt(n d^(n-1)); 4th-order Runge-Kutta.
  const auto force = [&](Real depth, Real speed) {
    if (depth < 0) return Real(0);  // at touch a linear dashpot pushes at once
    return std::pow(depth, exponent) + 2 * damping_ratio * std::sqrt(exponent * std::pow(depth, exponent - 1)) * speed;
  };
  const Real step = 1e-3;
  Real depth = 0, speed = 1;
  for (int i = 0; i < 200000; ++i) {
    const Real k1d = speed, k1v = -force(depth, speed);
    const Real k2d = speed + step / 2 * k1v, k2v = -force(depth + step / 2 * k1d, speed + step / 2 * k1v);
    const Real k3d = speed + step / 2 * k2v, k3v = -force(depth + step / 2 * k2d, speed + step / 2 * k2v);
    const Real k4d = speed + step * k3v, k4v = -force(depth + step * k3d, speed + step * k3v);
    depth += step / 6 * (k1d + 2 * k2d + 2 * k3d + k4d);
    speed += step / 6 * (k1v + 2 * k2v + 2 * k3v + k4v);
    if (speed < 0 && (depth <= 0 || force(depth, speed) <= 0)) return -speed;
    if (depth < 1e-9 && i > 10) break;
  }
  return 0;
}

namespace {

/// Damping ratio in 0 .. high, by bisection.
Real solved_ratio(Real exponent, Real restitution, Real high) {
  Real low = 0;
  for (int bisection = 0; bisection < 30; ++bisection) {
    const Real middle = (low + high) / 2;
    (impact_restitution(exponent, middle) > restitution ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

DampingRatios damping_ratios(Real restitution) {
  DampingRatios ratios;
  if (restitution >= 1) return ratios;
  for (int i = 0; i < 5; ++i) {
    constexpr Real stiffest = 3;  // that a dashpot evaluated once a step stands
    ratios.ratio[i] = solved_ratio(1 + Real(0.5) * i, restitution, stiffest);
  }
  return ratios;
}

Real damping_ratio(Real exponent, Real restitution) {
  constexpr Real beyond_the_least = 100;
  return restitution >= 1 ? 0 : solved_ratio(exponent, std::max(restitution, kLeastRestitution), beyond_the_least);
}

}  // namespace dem_gpu
