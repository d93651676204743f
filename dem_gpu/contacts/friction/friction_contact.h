// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_patch.h"
#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/contacts/restitution_damping.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

// A friction policy is a small struct of parameters with
//   kEnabled                                     false: no friction, no history
//   kHasCouple                                   whether it resists turning too, so that couples enter torques and work
//   Patch                                        what it asks of the geometry besides the elastic contact: NoPatch,
//                                                ContactPatch
//   apply(contacts, c, contact, patch)           forces of this step; renews the history of contact c, or of one a lane
//   forget(contacts, c)                          ends the history
// and the columns of ContactColumns that hold its history.

/// Damping and friction of a pair of materials.
template <class Number>
struct BasicPairProperties {
  Number damping_ratio{};  // of restitution_damping.h [-]
  Number friction_coefficient{};
  Number effective_modulus{};  // Hertz E* [Pa]
  // Of sphere contacts.
  Number sphere_damping{};              // damping ratio of the sphere law, of tangent stiffness [-]
  Number tangential_stiffness_ratio{};  // tangential over normal stiffness [-]
  Number rolling_friction{};            // mu_r [-]
  Number adhesion{};                    // work of adhesion [J/m2]
  Number sphere_tangential_damping{};   // damping ratio times the root of the stiffness ratio [-]
};
using PairProperties = BasicPairProperties<Real>;

/// Motion of a relative to b at the contact point, world frame.
template <class Number>
struct RelativeMotion {
  Vector3<Number> velocity;          // [m/s]
  Vector3<Number> angular_velocity;  // [rad/s]
};

/// What a friction policy sees of a touching contact, world frame.
template <class Number>
struct BasicFrictionContact {
  const BasicElasticContact<Number>& elastic;
  const BasicPairProperties<Number>& pair;
  Number damping;                      // part of the normal force, positive when repulsive [N]
  Number effective_mass;               // that an impulse along the normal meets [kg]
  Number diameter;                     // equivalent, of the smaller body [m]
  Real time_step;                      // [s]
  Number contact_share;                // of the body that has more contacts: 1 / number of them [-]
  RelativeMotion<Number> mean{};       // over the step: moves the springs
  RelativeMotion<Number> predicted{};  // for the end of the step: damping
  Vector3<Number> mean_spin{};         // mean angular velocity of a and b over the step [rad/s]

  /// Normal force on a, damping included, without adhesion: what presses the surfaces together [N]. Not negative: the
  /// mean force over a step of a contact on its orbit may pull, to make up for the step before.
  TALUS_HD Number normal_load() const {
    return larger(Number{}, damping + elastic.adhesion - dot(elastic.force, elastic.normal));
  }
};
using FrictionContact = BasicFrictionContact<Real>;

/// Friction on a; b gets the opposite.
template <class Number>
struct BasicFrictionForces {
  Vector3<Number> force;   // at the contact point [N]
  Vector3<Number> couple;  // [N m]
  Number energy{};         // stored in the springs [J]
};
using FrictionForces = BasicFrictionForces<Real>;

}  // namespace dem_gpu
