// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"

namespace dem_gpu {

/// Free rotation over `duration` by symmetric splitting into turns about the body's principal axes: second order,
/// time-reversible, conserves angular momentum exactly. Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997)
/// 5840-5851, section III. `momentum`: angular momentum in the body frame [kg m2/s].
TALUS_HD inline void rotate_freely(Quaternion& orientation, Vec3& momentum, const Vec3& inertia, Real duration) {
  const auto turn_x = [&](Real time) {
    const Real angle = time * momentum.x / inertia.x, c = std::cos(angle), s = std::sin(angle);
    momentum = {momentum.x, c * momentum.y + s * momentum.z, c * momentum.z - s * momentum.y};
    orientation = orientation * Quaternion{std::cos(angle / 2), std::sin(angle / 2), 0, 0};
  };
  const auto turn_y = [&](Real time) {
    const Real angle = time * momentum.y / inertia.y, c = std::cos(angle), s = std::sin(angle);
    momentum = {c * momentum.x - s * momentum.z, momentum.y, c * momentum.z + s * momentum.x};
    orientation = orientation * Quaternion{std::cos(angle / 2), 0, std::sin(angle / 2), 0};
  };
  const auto turn_z = [&](Real time) {
    const Real angle = time * momentum.z / inertia.z, c = std::cos(angle), s = std::sin(angle);
    momentum = {c * momentum.x + s * momentum.y, c * momentum.y - s * momentum.x, momentum.z};
    orientation = orientation * Quaternion{std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
  };
  turn_x(duration / 2);
  turn_y(duration / 2);
  turn_z(duration);
  turn_y(duration / 2);
  turn_x(duration / 2);
  orientation = normalized(orientation);
}

/// Turn by the rotation vector [rad] as a quaternion.
TALUS_HD inline Quaternion turn_by(const Vec3& rotation) {
  const Vec3 half = Real(0.5) * rotation;
  const Real square = norm_squared(half);
  Real cosine, sine_share;
  if (square < Real(0.01)) {  // to rounding, by the first terms of both series
    cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56 * (1 - square / 90))));
    sine_share = 1 - square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72)));
  } else {
    const Real angle = std::sqrt(square);
    cosine = std::cos(angle);
    sine_share = std::sin(angle) / angle;
  }
  return {cosine, sine_share * half.x, sine_share * half.y, sine_share * half.z};
}

/// Mean angular velocity that takes `from` to `to` in `duration` [rad/s], world frame.
TALUS_HD inline Vec3 mean_angular_velocity(const Quaternion& from, const Quaternion& to, Real duration) {
  Quaternion turn = to * conjugate(from);
  if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vec3 axis{turn.x, turn.y, turn.z};
  const Real sine = norm(axis);
  const Real factor = sine > Real(1e-6) ? 2 * std::atan2(sine, turn.w) / sine : 2 / turn.w;
  return (factor / duration) * axis;
}

}  // namespace dem_gpu
