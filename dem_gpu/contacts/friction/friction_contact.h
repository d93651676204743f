// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

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
//   apply(contacts, c, contact, patch)           forces of this step; renews the history of contact c
//   forget(contacts, c)                          ends the history
// and the columns of ContactColumns that hold its history.

/// Damping and friction of a pair of materials.
struct PairProperties {
  Real damping_ratio = 0;  // of restitution_damping.h [-]
  Real friction_coefficient = 0;
  Real effective_modulus = 0;  // Hertz E* [Pa]
  // Of sphere contacts.
  Real sphere_damping = 0;              // damping ratio of the sphere law, of tangent stiffness [-]
  Real tangential_stiffness_ratio = 0;  // tangential over normal stiffness [-]
  Real rolling_friction = 0;            // mu_r [-]
  Real adhesion = 0;                    // work of adhesion [J/m2]
  Real sphere_tangential_damping = 0;   // damping ratio times the root of the stiffness ratio [-]
};

/// Motion of a relative to b at the contact point, world frame.
struct RelativeMotion {
  Vec3 velocity;          // [m/s]
  Vec3 angular_velocity;  // [rad/s]
};

/// What a friction policy sees of a touching contact, world frame.
struct FrictionContact {
  const ElasticContact& elastic;
  const PairProperties& pair;
  Real damping;                // part of the normal force, positive when repulsive [N]
  Real effective_mass;         // that an impulse along the normal meets [kg]
  Real diameter;               // equivalent, of the smaller body [m]
  Real time_step;              // [s]
  Real contact_share;          // of the body that has more contacts: 1 / number of them [-]
  RelativeMotion mean{};       // over the step: moves the springs
  RelativeMotion predicted{};  // for the end of the step: damping
  Vec3 mean_spin{};            // mean angular velocity of a and b over the step [rad/s]

  /// Normal force on a, damping included, without adhesion: what presses the surfaces together [N]. Not negative: the
  /// mean force over a step of a contact on its orbit may pull, to make up for the step before.
  TALUS_HD Real normal_load() const {
    return std::max(Real(0), damping + elastic.adhesion - dot(elastic.force, elastic.normal));
  }
};

/// Friction on a; b gets the opposite.
struct FrictionForces {
  Vec3 force;       // at the contact point [N]
  Vec3 couple;      // [N m]
  Real energy = 0;  // stored in the springs [J]
};

}  // namespace dem_gpu
