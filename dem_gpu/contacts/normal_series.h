// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

/// Contact law and motion along the normal as a step begins, of one contact or of several side by side.
template <class Number>
struct NormalStart {
  Number depth;         // [m]
  Number per_depth;     // 1 / depth [1/m]
  Number speed;         // of approach [m/s]
  Number acceleration;  // of approach, by everything but the contact [m/s2]
  Number elastic;       // elastic force / m_eff at this depth [m/s2]
  Number damping;       // dashpot / m_eff at this depth [1/s]
  Number adhesion;      // attraction / m_eff [m/s2]
};

/// The faces part too fast for the spring to follow all through the step: overlap is left, and no force.
template <class Number>
TALUS_HD auto is_let_go(const NormalStart<Number>& start, Real step) {
  const Number fastest = start.speed + step * larger(Number{}, start.acceleration);
  return (start.elastic + start.damping * fastest <= Real(0)) & (start.adhesion == Real(0));
}

/// What a step along the orbit takes of the approach speed.
template <class Number>
struct NormalKick {
  Number kick;  // [m/s]
  Number mean;  // of what has been taken, over the step: what Verlet's kick must be to take the pair there [m/s]
};

/// The orbit of normal_orbit.h over a step as a power series in time. Depth over depth at the start is 1 there, so that
/// the powers of it in the law have series without roots (J.C.P. Miller's recurrence: Knuth, The Art of Computer
/// Programming 2, section 4.7). Most contacts of a bed change little in a step; `is_good` says of which this is the
/// orbit to kSeriesTolerance.
template <class Law, class Number>
struct NormalSeries {
  static constexpr int kOrder = 5;  // of the contact's acceleration
  /// Last term over the elastic kick of a step, at most: what is left out is a few times smaller, and restitution right
  /// to 1e-6 at 20 steps a contact.
  static constexpr Real kSeriesTolerance = Real(1e-4);

  // Times in steps, lengths in depths at the start.
  Number depth[kOrder + 3];    // coefficients of depth
  Number contact[kOrder + 1];  // of the contact's acceleration, adhesion apart

  TALUS_HD NormalKick<Number> advance(const NormalStart<Number>& start, Real step) {
    constexpr Real kForcePower = Law::kExponent, kDampingPower = (Law::kExponent - 1) / 2;
    const Number to_share = step * step * start.per_depth;
    const Number elastic = to_share * start.elastic, damping = step * start.damping;
    const Number others = to_share * (start.acceleration + start.adhesion);
    Number force[kOrder + 1], dashpot[kOrder + 1];
    depth[0] = force[0] = dashpot[0] = Number{} + Real(1);
    depth[1] = step * start.speed * start.per_depth;
    Number kick = Number{}, shift = Number{};
    TALUS_UNROLL
    for (int k = 0; k <= kOrder; ++k) {
      if (k > 0) {
        force[k] = next_of_power(force, k, kForcePower);
        dashpot[k] = next_of_power(dashpot, k, kDampingPower);
      }
      Number drag = (k + 1) * depth[k + 1];
      TALUS_UNROLL
      for (int j = 1; j <= k; ++j) drag += dashpot[j] * ((k - j + 1) * depth[k - j + 1]);
      contact[k] = elastic * force[k] + damping * drag;
      kick += contact[k] * (Real(1) / (k + 1));
      shift += contact[k] * (Real(1) / ((k + 1) * (k + 2)));
      depth[k + 2] = ((k == 0 ? others : Number{}) - contact[k]) * (Real(1) / ((k + 1) * (k + 2)));
    }
    last_share_ = elastic;
    const Number adhesion = to_share * start.adhesion;
    const Number speed = start.depth * (1 / step);
    return {speed * (kick - adhesion), speed * (shift - adhesion * Real(0.5))};
  }

  /// The terms have become small, and elastic and damping force together push all through the step.
  TALUS_HD auto is_good() const {
    Number changes = magnitude(contact[1]);
    TALUS_UNROLL
    for (int k = 2; k <= kOrder; ++k) changes += magnitude(contact[k]);
    const Number last = magnitude(contact[kOrder]) + kLastButOne * magnitude(contact[kOrder - 1]);
    return (last <= kSeriesTolerance * last_share_) & (changes < contact[0]);
  }

 private:
  /// The last term may pass through zero.
  static constexpr Real kLastButOne = Real(0.05);
  Number last_share_;

  /// Coefficient k of depth^power from those before.
  TALUS_HD Number next_of_power(const Number* of_power, int k, Real power) const {
    Number sum = Number{};
    TALUS_UNROLL
    for (int j = 1; j <= k; ++j) sum += ((power + 1) * j / k - 1) * depth[j] * of_power[k - j];
    return sum;
  }
};

}  // namespace dem_gpu
