// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/contacts/restitution_damping.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/walls/wall_columns.h"

namespace dem_gpu {

/// One side of a contact: a body, or a wall of infinite mass.
struct ContactSide {
  Vec3 centre;  // of mass, or the wall's rotation centre [m]
  Vec3 predicted_velocity, predicted_angular_velocity;
  Vec3 mean_velocity, mean_angular_velocity;
  Real inverse_mass = 0;  // [1/kg]
  Vec3 inverse_inertia;   // principal [1/(kg m2)]
  Mat3 rotation;

  TALUS_HD Vec3 predicted_velocity_at(const Vec3& x) const {
    return predicted_velocity + cross(predicted_angular_velocity, x - centre);
  }
  TALUS_HD Vec3 mean_velocity_at(const Vec3& x) const {
    return mean_velocity + cross(mean_angular_velocity, x - centre);
  }
  /// 1 / mass that an impulse along n at x meets [1/kg].
  TALUS_HD Real inverse_effective_mass(const Vec3& x, const Vec3& n) const {
    const Vec3 arm = transpose_times(rotation, cross(x - centre, n));
    return inverse_mass + dot(arm, hadamard(inverse_inertia, arm));
  }
};

TALUS_HD inline ContactSide body_side(const BodyView& bodies, int body) {
  const Vec3 inertia = bodies.inertia[body];
  return {bodies.position[body],
          bodies.predicted_velocity[body],
          bodies.predicted_angular_velocity[body],
          bodies.mean_velocity[body],
          bodies.mean_angular_velocity[body],
          1 / bodies.mass[body],
          {1 / inertia.x, 1 / inertia.y, 1 / inertia.z},
          rotation_matrix(bodies.orientation[body])};
}

TALUS_HD inline ContactSide wall_side(const WallRecord& wall) {
  return {wall.rotation_centre,
          wall.velocity,
          wall.angular_velocity,
          wall.mean_velocity,
          wall.mean_angular_velocity,
          0,
          {},
          {}};
}

/// Damping and friction of a pair of materials.
struct PairProperties {
  DampingRatios damping;
  Real friction_coefficient = 0;
  Real effective_modulus = 0;  // Hertz E* [Pa]
};

struct NoFriction {
  static constexpr bool kEnabled = false;
};
struct CoulombFriction {
  static constexpr bool kEnabled = true;
  Real tangential_stiffness_ratio;  // [-]
};
struct NoWorkRecord {
  static constexpr bool kEnabled = false;
};
struct WorkRecord {
  static constexpr bool kEnabled = true;
};

struct ContactForces {
  Vec3 damping;                // on a [N]
  Vec3 friction;               // on a [N]
  Real tangential_energy = 0;  // [J]
};

/// Damping along the normal; the whole normal force never pulls.
TALUS_HD inline Real normal_damping(const ElasticContact& elastic, const PairProperties& pair, Real effective_mass,
                                    Real approach_speed) {
  const Real force = norm(elastic.force);
  const Real exponent = elastic.stiffness * elastic.depth / force;
  const Real coefficient = 2 * pair.damping.at(exponent) * std::sqrt(effective_mass * elastic.stiffness);
  return std::max(coefficient * approach_speed, -force);
}

/// Coulomb friction with a tangential spring. Cundall & Strack, Geotechnique 29 (1979) 47-65. The spring follows the
/// contact plane as it turns.
struct TangentialSpring {
  Vec3 displacement;  // in: last step; out: this step [m]
  Real stiffness;     // [N/m]
  Real damping;       // [N s/m]

  TALUS_HD Vec3 force(const Vec3& normal, const Vec3& mean_slip, const Vec3& predicted_slip, Real time_step,
                      Real limit) {
    const Real length = norm(displacement);
    displacement -= dot(displacement, normal) * normal;
    const Real turned = norm(displacement);
    if (turned > 0) displacement *= length / turned;
    displacement += time_step * mean_slip;
    Vec3 trial = -stiffness * displacement - damping * predicted_slip;
    const Real magnitude = norm(trial);
    if (magnitude > limit) {
      trial *= limit / magnitude;
      // The spring gives way: what is left of it balances the limit.
      displacement = stiffness > 0 ? (-1 / stiffness) * (trial + damping * predicted_slip) : Vec3{};
      const Real left = stiffness * norm(displacement);
      if (left > limit) displacement *= limit / left;
    }
    return trial;
  }
};

/// Work of the step that ends now, by the trapezoidal rule over the mean velocities: the same quadrature as the
/// integrator's, so that the ledger measures its error and adds none of its own.
struct StepWork {
  Real elastic = 0, damping = 0, friction = 0;  // done on the bodies [J]
  Real by_wall = 0;                             // done by side b's own motion on a [J]
};

TALUS_HD inline StepWork step_work(const ContactView& contacts, int c, const ElasticContact& elastic,
                                   const Vec3& torque_b, const ContactForces& forces, const ContactSide& a,
                                   const ContactSide& b, Real time_step) {
  const Real half = time_step / 2;
  StepWork work;
  const Vec3 force = contacts.last_elastic_force[c] + elastic.force;
  const Real on_b =
      half * (dot(contacts.last_elastic_torque_b[c] + torque_b, b.mean_angular_velocity) - dot(force, b.mean_velocity));
  work.elastic = half * (dot(force, a.mean_velocity) +
                         dot(contacts.last_elastic_torque_a[c] + elastic.torque_a, a.mean_angular_velocity)) +
                 on_b;
  const Vec3 velocity_a = a.mean_velocity_at(elastic.point), velocity_b = b.mean_velocity_at(elastic.point);
  const Vec3 damping = contacts.last_damping_force[c] + forces.damping;
  const Vec3 friction = contacts.last_friction_force[c] + forces.friction;
  work.damping = half * dot(damping, velocity_a - velocity_b);
  work.friction = half * dot(friction, velocity_a - velocity_b);
  work.by_wall = -on_b + half * dot(damping + friction, velocity_b);
  return work;
}

/// Adds a step's work to the ledger columns. The elastic account is closed when the contact ends: whatever is left in
/// it then was not recovered, and shows as imbalance.
TALUS_HD inline void record_work(const ContactView& contacts, int c, const StepWork& work, Real tangential_energy,
                                 bool is_touching, bool is_wall) {
  contacts.elastic_work[c] = is_touching ? contacts.elastic_work[c] - work.elastic : 0;
  contacts.loss_normal[c] -= work.damping;
  contacts.loss_shear[c] -= work.friction + (tangential_energy - contacts.tangential_energy[c]);
  contacts.tangential_energy[c] = tangential_energy;
  if (is_wall) contacts.wall_work[c] += work.by_wall;
}

/// No force this step; the history ends.
template <class Friction, class Record>
TALUS_HD void end_contact(const ContactView& contacts, int c, const ContactSide& a, const ContactSide& b,
                          Real time_step) {
  if (contacts.depth[c] == 0) return;
  if constexpr (Record::kEnabled) {
    ElasticContact none;
    none.point = contacts.point[c];
    const StepWork work = step_work(contacts, c, none, Vec3{}, ContactForces{}, a, b, time_step);
    record_work(contacts, c, work, 0, false, is_wall_kind(key_kind(contacts.key[c])));
    contacts.last_elastic_force[c] = contacts.last_elastic_torque_a[c] = contacts.last_elastic_torque_b[c] = Vec3{};
    contacts.last_damping_force[c] = contacts.last_friction_force[c] = Vec3{};
  }
  if constexpr (Friction::kEnabled) contacts.tangential_displacement[c] = Vec3{};
  contacts.force[c] = contacts.torque_a[c] = contacts.torque_b[c] = Vec3{};
  contacts.depth[c] = 0;
}

/// Completes a touching contact: damping, friction, forces on both sides, history, work.
template <class Friction, class Record>
TALUS_HD void respond(const ContactView& contacts, int c, const ElasticContact& elastic, const ContactSide& a,
                      const ContactSide& b, const PairProperties& pair, const Friction& friction, Real time_step,
                      Real diameter) {
  const Vec3 slip = a.predicted_velocity_at(elastic.point) - b.predicted_velocity_at(elastic.point);
  const Real approach_speed = dot(slip, elastic.normal);
  const Real effective_mass = 1 / (a.inverse_effective_mass(elastic.point, elastic.normal) +
                                   b.inverse_effective_mass(elastic.point, elastic.normal));
  ContactForces forces;
  const Real damping = normal_damping(elastic, pair, effective_mass, approach_speed);
  forces.damping = -damping * elastic.normal;
  if constexpr (Friction::kEnabled) {
    const Vec3 mean_slip = a.mean_velocity_at(elastic.point) - b.mean_velocity_at(elastic.point);
    TangentialSpring spring{contacts.tangential_displacement[c],
                            friction.tangential_stiffness_ratio * elastic.stiffness, 0};
    spring.damping = 2 * pair.damping.ratio[0] * std::sqrt(effective_mass * spring.stiffness);
    const Real limit = pair.friction_coefficient * (norm(elastic.force) + damping);
    forces.friction = spring.force(elastic.normal, mean_slip - dot(mean_slip, elastic.normal) * elastic.normal,
                                   slip - approach_speed * elastic.normal, time_step, limit);
    forces.tangential_energy = Real(0.5) * spring.stiffness * norm_squared(spring.displacement);
    contacts.tangential_displacement[c] = spring.displacement;
  }
  const Vec3 elastic_torque_b = cross(b.centre - a.centre, elastic.force) - elastic.torque_a;
  if constexpr (Record::kEnabled) {
    const StepWork work = step_work(contacts, c, elastic, elastic_torque_b, forces, a, b, time_step);
    record_work(contacts, c, work, forces.tangential_energy, true, is_wall_kind(key_kind(contacts.key[c])));
    contacts.last_elastic_force[c] = elastic.force;
    contacts.last_elastic_torque_a[c] = elastic.torque_a;
    contacts.last_elastic_torque_b[c] = elastic_torque_b;
    contacts.last_damping_force[c] = forces.damping;
    contacts.last_friction_force[c] = forces.friction;
  }
  const Vec3 at_point = forces.damping + forces.friction;
  contacts.force[c] = elastic.force + at_point;
  contacts.torque_a[c] = elastic.torque_a + cross(elastic.point - a.centre, at_point);
  contacts.torque_b[c] = elastic_torque_b - cross(elastic.point - b.centre, at_point);
  contacts.point[c] = elastic.point;
  contacts.depth[c] = elastic.depth;
  contacts.peak_overlap[c] = std::max(contacts.peak_overlap[c], elastic.depth / diameter);
  contacts.peak_rate[c] = std::max(contacts.peak_rate[c], elastic.stiffness / effective_mass);
  if (is_wall_kind(key_kind(contacts.key[c]))) {
    contacts.wall_impulse[c] -= time_step * contacts.force[c];
    contacts.wall_angular_impulse[c] += time_step * contacts.torque_b[c];
  }
}

}  // namespace dem_gpu
