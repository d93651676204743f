// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"

namespace dem_gpu {

/// How a polyhedral contact can carry friction, world frame. Symmetric, trace 1: the load-weighted mean of n n^T over
/// the flat patches of the contact, n their normals. What it leaves of a velocity is the slip that friction resists;
/// what it takes of an angular velocity is the spin.
template <class Number>
struct BasicContactPatch {
  BasicMat3<Number> normals;    // T [-]
  Number load{};                // sum of the patches' elastic normal forces [N]
  Number lever{};               // root of the load-weighted mean square distance from the contact point [m]
  Number stiffness_per_area{};  // of the normal law, flat on flat [N/m3]

  TALUS_HD Vector3<Number> spin(const Vector3<Number>& angular_velocity) const { return normals * angular_velocity; }
  TALUS_HD Vector3<Number> slip(const Vector3<Number>& velocity) const { return velocity - normals * velocity; }
};
using ContactPatch = BasicContactPatch<Real>;

/// Nothing is asked of the geometry besides the elastic contact.
struct NoPatch {};

}  // namespace dem_gpu
