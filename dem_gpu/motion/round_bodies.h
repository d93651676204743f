// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/broad_phase/list_wear.h"
#include "dem_gpu/core/row_blocks.h"
#include "dem_gpu/motion/rigid_body.h"

namespace dem_gpu {

/// Bodies with three equal moments, as many side by side as there are lanes: their axis stays over a step, so that one
/// turn does the whole of it.
struct RoundBodies {
  BodyView bodies;
  Real time_step;  // [s]
  ListWear wear;

  TALUS_HD static bool is_round(const Vec3& inertia) { return inertia.x == inertia.y && inertia.y == inertia.z; }

  /// Whether kRealLanes bodies from `first` on all move and are round.
  TALUS_HD bool are_here(int first) const {
    bool all = true;
    for (int i = first; i < first + kRealLanes && all; ++i) all = bodies.is_moving(i) && is_round(bodies.inertia[i]);
    return all;
  }

  /// One step of kRealLanes bodies from `first` on. False, and nothing done, if one turns so fast that the series of
  /// rigid_body.h do not hold.
  TALUS_HD bool advance(int first) const {
    using Vectors = Vector3<RealLanes>;
    const Vectors torque = load_rows(bodies.torque + first), inertia = load_rows(bodies.inertia + first);
    const BasicQuaternion<RealLanes> before = load_rows(bodies.orientation + first);
    const auto rotation = rotation_matrix(before);
    const Vectors turn_kick = time_step / 2 / inertia.x * torque;
    const Vectors in_body = load_rows(bodies.angular_velocity + first) + transpose_times(rotation, turn_kick);
    const Vectors turn = time_step * in_body;
    constexpr unsigned all = (1u << kRealLanes) - 1;
    if (bits_of(norm_squared(turn) < RealLanes{} + 4 * kSmallAngleSquared) != all) return false;
    const Vectors spin = rotation * in_body;
    store_rows(normalized(before * turn_by_small(turn)), bodies.orientation + first);
    store_rows(in_body, bodies.angular_velocity + first);
    store_rows(spin, bodies.mean_angular_velocity + first);
    store_rows(spin + turn_kick, bodies.predicted_angular_velocity + first);

    const Vectors kick = time_step / 2 * load_lanes_at(bodies.inverse_mass + first) * load_rows(bodies.force + first);
    const Vectors velocity = load_rows(bodies.velocity + first) + kick;
    const Vectors position = load_rows(bodies.position + first) + time_step * velocity;
    store_rows(position, bodies.position + first);
    store_rows(velocity, bodies.velocity + first);
    store_rows(velocity, bodies.mean_velocity + first);
    store_rows(velocity + kick, bodies.predicted_velocity + first);
    keep_track(first, position, velocity, in_body);
    return true;
  }

 private:
  /// As AdvanceBody::displacement.
  TALUS_HD void keep_track(int first, const Vector3<RealLanes>& position, const Vector3<RealLanes>& velocity,
                           const Vector3<RealLanes>& in_body) const {
    const RealLanes distance = norm(position - load_rows(bodies.listed_position + first));
    const RealLanes spin_squared = norm_squared(in_body), spin = square_root(spin_squared), speed = norm(velocity);
    const RealLanes radius = load_lanes_at(bodies.bounding_radius + first);
    const RealLanes width = load_lanes_at(bodies.least_width + first);
    const RealLanes turning = select(width < 2 * radius, radius * spin, RealLanes{});
    const RealLanes large = RealLanes{} + Real(1e300);
    const auto is_sound =
        (distance < large) & (spin_squared < large) & (time_step * (speed + turning) < kTravelShare * width);
    const RealLanes displacement = select(is_sound, distance, RealLanes{} + Real(HUGE_VAL));
    store_lanes_at(displacement, bodies.listed_displacement + first);
    wear.note(displacement);
    if (bodies.travel)
      store_lanes_at(load_lanes_at(bodies.travel + first) + time_step * (speed + radius * spin), bodies.travel + first);
  }
};

}  // namespace dem_gpu
