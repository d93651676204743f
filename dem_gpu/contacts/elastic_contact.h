// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// Elastic part of a contact between a and b (a body or a wall), world frame. Number: one contact, or several side by
/// side (RealLanes).
template <class Number>
struct BasicElasticContact {
  Vector3<Number> force;     // on a [N]
  Vector3<Number> torque_a;  // on a, about a's centre [N m]
  Vector3<Number> point;     // [m]
  Vector3<Number> normal;    // contact normal, unit, from a to b
  Number stiffness{};        // tangent stiffness dF/d(depth) [N/m]
  Number adhesion{};         // constant attraction included in `force` [N]
  Number curvature{};        // of the normal's turn as the centres slide past each other: 1 / their distance [1/m]
  Number depth{};            // largest depth [m]
  Number energy{};           // stored, of sphere laws [J]
};
using ElasticContact = BasicElasticContact<Real>;

/// Normal against the force on a; false if the force is zero.
TALUS_HD inline bool set_normal(ElasticContact& contact) {
  const Real magnitude = norm(contact.force);
  if (!(magnitude > 0)) return false;
  contact.normal = (-1 / magnitude) * contact.force;
  return true;
}

}  // namespace dem_gpu
