// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/core/host_device.h"
#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Force over effective mass of a contact F = F0 r^n + c0 r^((n - 1) / 2) * speed - F_a, r = depth / depth0, n = 1 or
/// 1.5. Elastic and damping force together never pull.
struct NormalAcceleration {
  Real per_depth;     // 1 / depth0 [1/m]
  Real elastic;       // F0 / m_eff [m/s2]
  Real damping;       // c0 / m_eff [1/s]
  Real adhesion = 0;  // F_a / m_eff [m/s2]
  bool is_hertz;      // n = 1.5, else 1

  /// Elastic and damping force against approach; negative: it has let go [m/s2].
  TALUS_HD Real unclamped(Real depth, Real speed) const {
    const Real r = std::max(depth, Real(0)) * per_depth;
    if (!is_hertz) return elastic * r + damping * speed;
    const Real root = std::sqrt(r);
    return elastic * r * root + damping * std::sqrt(root) * speed;
  }
  TALUS_HD Real operator()(Real depth, Real speed) const {
    return std::max(unclamped(depth, speed), Real(0)) - adhesion;
  }
};

/// Motion of two bodies along the normal of their contact over one step, integrated in sub-steps, so that where in the
/// step they touch and let go does not change the rebound. Other forces enter as a constant acceleration.
struct NormalOrbit {
  NormalAcceleration force;
  Real start_depth;   // [m]
  Real start_speed;   // of approach [m/s]
  Real acceleration;  // of approach, by everything else [m/s2]

  // Loss of approach speed through the contact [m/s], and its integral over time [m].
  Real kick = 0, shift = 0;
  bool has_parted = false;  // it has let go, and no overlap is left at the end

  /// Moves the start to where the bodies touched, at most `limit` ago, as they came freely; the time since then [s].
  TALUS_HD Real back_to_touch(Real limit) {
    const Real touch_speed = std::sqrt(std::max(start_speed * start_speed - 2 * acceleration * start_depth, Real(0)));
    const Real time = std::min(limit, 2 * start_depth / (start_speed + touch_speed));
    start_depth = 0;
    start_speed = touch_speed;
    return time;
  }

  /// Sub-steps grow as the fourth power of their number if `is_first`: after touch, damping grows as time^(1/4).
  TALUS_HD void advance(Real duration, int substeps, bool is_first) {
    Point point{0, 0};
    Real begin = 0;
    for (int i = 1; i <= substeps; ++i) {
      const Real share = static_cast<Real>(i) / substeps;
      const Real end = duration * (is_first ? share * share * share * share : share);
      const Point after = stepped(point, begin, end - begin);
      if (has_let_go(end, after)) {
        const Real held = time_to_release(point, begin, after, end - begin);
        if (held > 0) point = stepped(point, begin, held);
        point.shift += point.kick * (duration - begin - held);
        has_parted = depth(duration, point) <= 0;
        break;
      }
      point = after;
      begin = end;
    }
    kick = point.kick;
    shift = point.shift;
  }

 private:
  struct Point {
    Real kick, shift;
  };

  TALUS_HD Real speed(Real time, const Point& p) const { return start_speed + acceleration * time - p.kick; }
  TALUS_HD Real depth(Real time, const Point& p) const {
    return start_depth + (start_speed + acceleration * time / 2) * time - p.shift;
  }
  TALUS_HD bool has_let_go(Real time, const Point& p) const {
    if (speed(time, p) >= 0) return false;
    return depth(time, p) <= 0 || (force.adhesion == 0 && force.unclamped(depth(time, p), speed(time, p)) <= 0);
  }

  /// Classical Runge-Kutta, fourth order.
  TALUS_HD Point stepped(const Point& p, Real time, Real h) const {
    const auto rate = [&](Real at, const Point& q) { return force(depth(at, q), speed(at, q)); };
    const Real a1 = rate(time, p);
    const Real v2 = p.kick + h / 2 * a1, a2 = rate(time + h / 2, {v2, p.shift + h / 2 * p.kick});
    const Real v3 = p.kick + h / 2 * a2, a3 = rate(time + h / 2, {v3, p.shift + h / 2 * v2});
    const Real v4 = p.kick + h * a3, a4 = rate(time + h, {v4, p.shift + h * v3});
    return {p.kick + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), p.shift + h / 6 * (p.kick + 2 * v2 + 2 * v3 + v4)};
  }

  /// Falls through zero where it lets go: smooth there, unlike the force itself.
  TALUS_HD Real hold(Real time, const Point& p) const {
    if (force.adhesion != 0 || force.damping == 0) return depth(time, p) * force.per_depth;
    const Real r = std::max(depth(time, p), Real(0)) * force.per_depth;
    const Real root = std::sqrt(r);
    return force.elastic * (force.is_hertz ? r * std::sqrt(root) : r) + force.damping * speed(time, p);
  }

  /// From the start of the sub-step, of length h, at whose end, `after`, it has let go [s]: regula falsi that halves
  /// the value at the end that stays (Dowell & Jarratt, BIT 11 (1971) 168-174).
  TALUS_HD Real time_to_release(const Point& p, Real time, const Point& after, Real h) const {
    Real low = 0, high = h;
    Real at_low = hold(time, p), at_high = hold(time + h, after);
    // It let go in a step before, and faces that part too fast for the spring still overlap.
    if (at_low <= 0 && speed(time, p) < 0) return 0;
    const Real small = kReleaseTolerance * (std::abs(at_low) + std::abs(at_high));
    int side = 0;  // that moved last
    for (int i = 0; i < kMostReleaseSteps && high - low > kReleaseTolerance * h; ++i) {
      // Where the values tell nothing, half way.
      const Real share = at_low > 0 && at_high < 0 ? at_low / (at_low - at_high) : Real(0.5);
      const Real middle = low + (high - low) * share;
      const Real value = hold(time + middle, stepped(p, time, middle));
      if (std::abs(value) <= small) return middle;
      if (value > 0) {
        low = middle;
        at_low = value;
        if (side > 0) at_high /= 2;
        side = 1;
      } else {
        high = middle;
        at_high = value;
        if (side < 0) at_low /= 2;
        side = -1;
      }
    }
    return low;
  }

  /// Of a sub-step, and of what holds the pair: the force is small at release, so the speed is right to 1e-8 and
  /// better.
  static constexpr Real kReleaseTolerance = Real(1e-6);
  static constexpr int kMostReleaseSteps = 20;
};

}  // namespace dem_gpu
