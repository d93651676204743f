// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"

namespace dem_gpu {

/// Cosine and sine over the angle, from the angle's square below kSmallAngleSquared: the first terms of their series,
/// to rounding.
constexpr Real kSmallAngleSquared = Real(0.01);  // [rad2]
template <class Number>
TALUS_HD inline Number cosine_of_small(const Number& square) {
  const Number one = Number{} + Real(1);
  return one -
         Real(1) / 2 * square *
             (one - Real(1) / 12 * square *
                        (one - Real(1) / 30 * square * (one - Real(1) / 56 * square * (one - Real(1) / 90 * square))));
}
template <class Number>
TALUS_HD inline Number sine_share_of_small(const Number& square) {
  const Number one = Number{} + Real(1);
  return one - Real(1) / 6 * square *
                   (one - Real(1) / 20 * square * (one - Real(1) / 42 * square * (one - Real(1) / 72 * square)));
}

/// Cosine and sine of half an angle, and of the whole.
struct HalfAngle {
  Real cosine, sine;

  TALUS_HD explicit HalfAngle(Real angle) {
    const Real half = angle / 2, square = half * half;
    const bool is_small = square < kSmallAngleSquared;
    cosine = is_small ? cosine_of_small(square) : std::cos(half);
    sine = is_small ? half * sine_share_of_small(square) : std::sin(half);
  }
  TALUS_HD Real whole_cosine() const { return 1 - 2 * sine * sine; }
  TALUS_HD Real whole_sine() const { return 2 * sine * cosine; }
};

/// Free rotation over `duration` by symmetric splitting into turns about the body's principal axes: second order,
/// time-reversible, conserves angular momentum exactly. Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997)
/// 5840-5851, section III. `momentum`: angular momentum in the body frame [kg m2/s].
TALUS_HD inline void rotate_freely(Quaternion& orientation, Vec3& momentum, const Vec3& inertia, Real duration) {
  const Vec3 inverse{1 / inertia.x, 1 / inertia.y, 1 / inertia.z};
  const auto turn_x = [&](Real time) {
    const HalfAngle half(time * momentum.x * inverse.x);
    const Real c = half.whole_cosine(), s = half.whole_sine();
    momentum = {momentum.x, c * momentum.y + s * momentum.z, c * momentum.z - s * momentum.y};
    orientation = orientation * Quaternion{half.cosine, half.sine, 0, 0};
  };
  const auto turn_y = [&](Real time) {
    const HalfAngle half(time * momentum.y * inverse.y);
    const Real c = half.whole_cosine(), s = half.whole_sine();
    momentum = {c * momentum.x - s * momentum.z, momentum.y, c * momentum.z + s * momentum.x};
    orientation = orientation * Quaternion{half.cosine, 0, half.sine, 0};
  };
  const auto turn_z = [&](Real time) {
    const HalfAngle half(time * momentum.z * inverse.z);
    const Real c = half.whole_cosine(), s = half.whole_sine();
    momentum = {c * momentum.x + s * momentum.y, c * momentum.y - s * momentum.x, momentum.z};
    orientation = orientation * Quaternion{half.cosine, 0, 0, half.sine};
  };
  turn_x(duration / 2);
  turn_y(duration / 2);
  turn_z(duration);
  turn_y(duration / 2);
  turn_x(duration / 2);
  orientation = normalized(orientation);
}

/// Turn by the rotation vector [rad] as a quaternion; by a small one, whose half has a square below kSmallAngleSquared.
template <class Number>
TALUS_HD inline BasicQuaternion<Number> turn_by_small(const Vector3<Number>& rotation) {
  const Vector3<Number> half = Real(0.5) * rotation;
  const Number square = norm_squared(half), sine_share = sine_share_of_small(square);
  return {cosine_of_small(square), sine_share * half.x, sine_share * half.y, sine_share * half.z};
}
TALUS_HD inline bool is_small_turn(const Vec3& rotation) { return norm_squared(rotation) < 4 * kSmallAngleSquared; }
TALUS_HD inline Quaternion turn_by(const Vec3& rotation) {
  if (is_small_turn(rotation)) return turn_by_small(rotation);
  const Real angle = norm(rotation), sine_share = std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), sine_share * rotation.x, sine_share * rotation.y, sine_share * rotation.z};
}

/// Mean angular velocity that takes `from` to `to` in `duration` [rad/s], world frame.
TALUS_HD inline Vec3 mean_angular_velocity(const Quaternion& from, const Quaternion& to, Real duration) {
  Quaternion turn = to * conjugate(from);
  if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vec3 axis{turn.x, turn.y, turn.z};
  const Real square = norm_squared(axis);
  if (square < Real(0.0025)) {  // angle over sine, by the first terms of arcsin's series, to rounding
    const Real factor =
        2 + square * (Real(1) / 3 +
                      square * (Real(3) / 20 +
                                square * (Real(5) / 56 + square * (Real(35) / 576 + square * (Real(63) / 1408)))));
    return (factor / duration) * axis;
  }
  const Real sine = std::sqrt(square);
  return (2 * std::atan2(sine, turn.w) / (sine * duration)) * axis;
}

}  // namespace dem_gpu
