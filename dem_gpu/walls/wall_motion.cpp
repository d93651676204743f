// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/walls/wall_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem_gpu {
namespace {

/// Integral of the speed ramp from start_time: the time at full speed that gives the same travel [s].
Real effective_time(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  if (elapsed <= 0) return 0;
  if (motion.ramp_time <= 0) return elapsed;
  if (elapsed < motion.ramp_time) return elapsed * elapsed / (2 * motion.ramp_time);
  return elapsed - motion.ramp_time / 2;
}

Real ramp_share(const Motion& motion, Real elapsed) {
  return motion.ramp_time > 0 ? std::min(Real(1), elapsed / motion.ramp_time) : Real(1);
}

Real speed_share(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  return elapsed > 0 ? ramp_share(motion, elapsed) : 0;
}

Real circular_frequency(const Motion& motion) { return 2 * std::numbers::pi_v<Real> * motion.frequency; }

/// Displacement of the oscillation / its amplitude: 0 at the start, whatever the phase.
Real swing(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  if (elapsed <= 0 || motion.frequency == 0) return 0;
  return ramp_share(motion, elapsed) *
         (std::sin(circular_frequency(motion) * elapsed + motion.phase) - std::sin(motion.phase));
}

/// d swing / dt [1/s]
Real swing_rate(const Motion& motion, Real time) {
  const Real elapsed = time - motion.start_time;
  if (elapsed <= 0 || motion.frequency == 0) return 0;
  const Real omega = circular_frequency(motion), angle = omega * elapsed + motion.phase;
  const Real rate = ramp_share(motion, elapsed) * omega * std::cos(angle);
  if (elapsed >= motion.ramp_time) return rate;
  return rate + (std::sin(angle) - std::sin(motion.phase)) / motion.ramp_time;
}

/// Turn by `share` of the rotation vector [rad].
Quaternion turn(const Vec3& rotation, Real share) {
  const Real angle = norm(rotation);
  return angle == 0 ? Quaternion{} : axis_angle(rotation / angle, angle * share);
}

}  // namespace

bool is_oscillating(const Motion& motion) {
  return motion.frequency != 0 && (norm(motion.amplitude) > 0 || norm(motion.angular_amplitude) > 0);
}

bool is_moving(const Motion& motion) {
  return norm(motion.velocity) > 0 || norm(motion.angular_velocity) > 0 || is_oscillating(motion);
}

WallPlace place_at(const Motion& motion, Real time) {
  const Real effective = effective_time(motion, time), swung = swing(motion, time);
  return {turn(motion.angular_amplitude, swung) * turn(motion.angular_velocity, effective),
          effective * motion.velocity + swung * motion.amplitude};
}

WallRate rate_at(const Motion& motion, Real time) {
  const Real share = speed_share(motion, time), rate = swing_rate(motion, time);
  return {share * motion.velocity + rate * motion.amplitude,
          rotate(turn(motion.angular_amplitude, swing(motion, time)), share * motion.angular_velocity) +
              rate * motion.angular_amplitude};
}

WallRate mean_rate(const Motion& motion, Real from, Real to) {
  if (!(to > from)) return rate_at(motion, to);
  const Real share = (effective_time(motion, to) - effective_time(motion, from)) / (to - from);
  const Real rate = (swing(motion, to) - swing(motion, from)) / (to - from);
  const Real middle = (swing(motion, to) + swing(motion, from)) / 2;
  return {share * motion.velocity + rate * motion.amplitude,
          rotate(turn(motion.angular_amplitude, middle), share * motion.angular_velocity) +
              rate * motion.angular_amplitude};
}

MotionRange motion_range(const Motion& motion, Real until) {
  MotionRange range{effective_time(motion, until), 0, 0};
  const Real elapsed = until - motion.start_time;
  if (motion.frequency == 0 || !(elapsed > 0)) return range;
  constexpr Real turn = 2 * std::numbers::pi_v<Real>;
  const Real from = motion.phase, to = from + std::min(turn, circular_frequency(motion) * elapsed);
  const auto passes = [&](Real angle) { return std::floor((to - angle) / turn) > std::floor((from - angle) / turn); };
  const Real start = std::sin(from), end = std::sin(to);
  range.swing_low = (passes(-turn / 4) ? Real(-1) : std::min(start, end)) - start;
  range.swing_high = (passes(turn / 4) ? Real(1) : std::max(start, end)) - start;
  return range;
}

WallTravel travel(const Motion& motion, Real from, Real to) {
  const Real span = effective_time(motion, to) - effective_time(motion, from);
  const Real swung = swing(motion, to) - swing(motion, from);
  return {norm(span * motion.velocity + swung * motion.amplitude), std::abs(span) * norm(motion.angular_velocity),
          std::abs(swung) * norm(motion.angular_amplitude)};
}

WallTravel largest_travel(const Motion& motion, Real span) {
  // The ramp of the amplitude adds to the swing's own rate; from end to end a swing goes twice its amplitude.
  const Real rate = circular_frequency(motion) + (motion.ramp_time > 0 ? 2 / motion.ramp_time : Real(0));
  const Real swung = motion.frequency != 0 ? std::min(Real(2), span * rate) : Real(0);
  return {span * norm(motion.velocity) + swung * norm(motion.amplitude), span * norm(motion.angular_velocity),
          swung * norm(motion.angular_amplitude)};
}

}  // namespace dem_gpu
