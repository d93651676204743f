// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Elastic part of a contact between a and b (a body or a wall), world frame.
struct ElasticContact {
  Vec3 force;          // on a [N]
  Vec3 torque_a;       // on a, about a's centre [N m]
  Vec3 point;          // [m]
  Vec3 normal;         // contact normal, unit, from a to b
  Real stiffness = 0;  // tangent stiffness dF/d(depth) [N/m]
  Real adhesion = 0;   // constant attraction included in `force` [N]
  Real curvature = 0;  // of the normal's turn as the centres slide past each other: 1 / their distance [1/m]
  Real depth = 0;      // largest depth [m]
  Real energy = 0;     // stored, of sphere laws [J]
};

/// Normal against the force on a; false if the force is zero.
TALUS_HD inline bool set_normal(ElasticContact& contact) {
  const Real magnitude = norm(contact.force);
  if (!(magnitude > 0)) return false;
  contact.normal = (-1 / magnitude) * contact.force;
  return true;
}

}  // namespace dem_gpu
