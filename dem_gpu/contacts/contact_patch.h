// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"

namespace dem_gpu {

/// How a polyhedral contact can carry friction, world frame. Symmetric, trace 1: the load-weighted mean of n n^T over
/// the flat patches of the contact, n their normals. What it leaves of a velocity is the slip that friction resists;
/// what it takes of an angular velocity is the spin.
struct ContactPatch {
  Mat3 normals;                 // T [-]
  Real load = 0;                // sum of the patches' elastic normal forces [N]
  Real lever = 0;               // root of the load-weighted mean square distance from the contact point [m]
  Real stiffness_per_area = 0;  // of the normal law, flat on flat [N/m3]

  TALUS_HD Vec3 spin(const Vec3& angular_velocity) const { return normals * angular_velocity; }
  TALUS_HD Vec3 slip(const Vec3& velocity) const { return velocity - normals * velocity; }
};

/// Nothing is asked of the geometry besides the elastic contact.
struct NoPatch {};

}  // namespace dem_gpu
