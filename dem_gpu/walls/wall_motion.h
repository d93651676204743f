// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

// A wall's prescribed motion as a function of time alone.

bool is_moving(const Motion& motion);
bool is_oscillating(const Motion& motion);

/// From the wall's place at time 0: turned about the rotation centre, then moved.
struct WallPlace {
  Quaternion rotation;
  Vec3 shift;  // of the rotation centre [m]
};
WallPlace place_at(const Motion& motion, Real time);

/// Of the material point at the rotation centre, and of the wall about it, world frame.
struct WallRate {
  Vec3 velocity;          // [m/s]
  Vec3 angular_velocity;  // [rad/s]
};
WallRate rate_at(const Motion& motion, Real time);
/// Mean over the time between: what moves the wall exactly as far.
WallRate mean_rate(const Motion& motion, Real from, Real to);

/// What a motion goes through from time 0 on.
struct MotionRange {
  Real full_speed_time = 0;            // times velocity and angular velocity: drift and rotation, from 0 on [s]
  Real swing_low = 0, swing_high = 0;  // displacement of the oscillation / its amplitude, 0 within
};
/// Up to time `until`, which may be infinite; a ramp of the amplitude is taken as if it were over.
MotionRange motion_range(const Motion& motion, Real until);

/// How far the motion has gone between two times: the rotation centre [m], and turning about the axis of rotation and
/// that of the swing [rad].
struct WallTravel {
  Real shift = 0, turn = 0, swing = 0;
};
WallTravel travel(const Motion& motion, Real from, Real to);
/// Bound of what it goes in any time of length `span` [s].
WallTravel largest_travel(const Motion& motion, Real span);

}  // namespace dem_gpu
