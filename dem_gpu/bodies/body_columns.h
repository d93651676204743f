// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// How far any point of a body may travel in a step, in least widths. At half the width two bodies that meet head on
/// could each reach the other's middle between two looks, beyond which the contact would push them on through.
inline constexpr Real kTravelShare = Real(0.25);

/// Values of BodyColumns::active.
enum class BodyState : char { removed = 0, moving = 1, fixed = 2 };

/// What does not change during a run, one entry a body (n_bodies).
struct BodyConstants {
  DeviceVector<int> shape;
  DeviceVector<int> material;
  DeviceVector<Real> scale;            // [-]
  DeviceVector<Real> mass;             // [kg]
  DeviceVector<Real> inverse_mass;     // 0 for a fixed body [1/kg]
  DeviceVector<Vec3> inertia;          // principal [kg m2]
  DeviceVector<Vec3> inverse_inertia;  // 0 for a fixed body [1/(kg m2)]
  DeviceVector<Real> bounding_radius;  // [m]
  DeviceVector<Real> diameter;         // of the sphere of equal volume [m]
  DeviceVector<Real> least_width;      // between parallel planes, see shapes/least_width.h [m]
};

/// Moving state of the bodies, one entry each (n_bodies).
struct BodyColumns {
  DeviceVector<char> active;             // BodyState; 0 once removed
  DeviceVector<Vec3> position;           // centre of mass, world frame [m]
  DeviceVector<Quaternion> orientation;  // unit, body to world
  DeviceVector<Vec3> velocity;           // world frame [m/s]
  DeviceVector<Vec3> angular_velocity;   // body frame, principal axes [rad/s]
  DeviceVector<Vec3> force;              // world frame, gravity included [N]
  DeviceVector<Vec3> torque;             // about the centre, world frame [N m]
  // Velocities that contacts see, world frame: predicted for the end of the step (laws), and mean over the step (work).
  DeviceVector<Vec3> predicted_velocity;          // [m/s]
  DeviceVector<Vec3> predicted_angular_velocity;  // [rad/s]
  DeviceVector<Vec3> mean_velocity;               // [m/s]
  DeviceVector<Vec3> mean_angular_velocity;       // [rad/s]
  DeviceVector<Real> contact_share;               // 1 / contacts when forces were last summed, at most 1 [-]
  DeviceVector<Vec3> listed_position;             // when the neighbour list was built [m]
  /// With pairs of polyhedra that wait: no point of the body has moved further than this since time 0, step by step
  /// [m].
  DeviceVector<Real> travel;
  DeviceVector<Real> listed_displacement;  // distance from it; infinite if the body has gone wrong [m]
};

struct BodyView {
  int count;
  const int* shape;
  const int* material;
  const Real* scale;
  const Real* mass;
  const Real* inverse_mass;
  const Vec3* inertia;
  const Vec3* inverse_inertia;
  const Real* bounding_radius;
  const Real* diameter;
  const Real* least_width;
  char* active;
  Vec3* position;
  Quaternion* orientation;
  Vec3* velocity;
  Vec3* angular_velocity;
  Vec3* force;
  Vec3* torque;
  Vec3* predicted_velocity;
  Vec3* predicted_angular_velocity;
  Vec3* mean_velocity;
  Vec3* mean_angular_velocity;
  Real* contact_share;
  Vec3* listed_position;
  Real* travel;
  Real* listed_displacement;

  /// Largest distance of a point from the centre that turning moves about; 0 for a sphere, which turns onto itself [m].
  TALUS_HD Real turning_radius(int i) const {
    return least_width[i] < 2 * bounding_radius[i] ? bounding_radius[i] : Real(0);
  }
  TALUS_HD bool is_moving(int i) const { return active[i] == static_cast<char>(BodyState::moving); }
  TALUS_HD bool is_fixed(int i) const { return active[i] == static_cast<char>(BodyState::fixed); }
};

inline BodyView view(const BodyConstants& constants, BodyColumns& columns) {
  return {static_cast<int>(constants.shape.size()),
          pointer(constants.shape),
          pointer(constants.material),
          pointer(constants.scale),
          pointer(constants.mass),
          pointer(constants.inverse_mass),
          pointer(constants.inertia),
          pointer(constants.inverse_inertia),
          pointer(constants.bounding_radius),
          pointer(constants.diameter),
          pointer(constants.least_width),
          pointer(columns.active),
          pointer(columns.position),
          pointer(columns.orientation),
          pointer(columns.velocity),
          pointer(columns.angular_velocity),
          pointer(columns.force),
          pointer(columns.torque),
          pointer(columns.predicted_velocity),
          pointer(columns.predicted_angular_velocity),
          pointer(columns.mean_velocity),
          pointer(columns.mean_angular_velocity),
          pointer(columns.contact_share),
          pointer(columns.listed_position),
          pointer(columns.travel),
          pointer(columns.listed_displacement)};
}

}  // namespace dem_gpu
