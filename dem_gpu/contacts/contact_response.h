// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/normal_damping.h"
#include "dem_gpu/core/row_columns.h"
#include "dem_gpu/narrow_phase/part_frame.h"
#include "dem_gpu/walls/wall_columns.h"

namespace dem_gpu {

/// One side of a contact: a body, or a wall of infinite mass. Number: of one contact, or of several side by side.
template <class Number>
struct BasicContactSide {
  using Vector = Vector3<Number>;

  Vector centre;  // of mass, or the wall's rotation centre [m]
  Vector predicted_velocity, predicted_angular_velocity;
  Vector mean_velocity, mean_angular_velocity;
  Number inverse_mass;     // [1/kg]
  Number contact_share;    // BodyColumns
  Vector inverse_inertia;  // principal [1/(kg m2)]
  BasicMat3<Number> rotation;

  TALUS_HD Vector predicted_velocity_at(const Vector& x) const {
    return predicted_velocity + cross(predicted_angular_velocity, x - centre);
  }
  TALUS_HD Vector mean_velocity_at(const Vector& x) const {
    return mean_velocity + cross(mean_angular_velocity, x - centre);
  }
  /// Where x was a point of it as the step of this length began: what was applied there did its work at this velocity.
  TALUS_HD Vector mean_velocity_at_start(const Vector& x, Real step) const {
    return mean_velocity + cross(mean_angular_velocity, x - (centre - (Number{} + step) * mean_velocity));
  }
  /// 1 / mass that an impulse along n at x meets [1/kg].
  TALUS_HD Number inverse_effective_mass(const Vector& x, const Vector& n) const {
    const Vector arm = transpose_times(rotation, cross(x - centre, n));
    return inverse_mass + dot(arm, hadamard(inverse_inertia, arm));
  }
};
using ContactSide = BasicContactSide<Real>;

/// `body`: a row of the body columns, or one a lane.
template <class Row>
TALUS_HD BasicContactSide<NumberOf<Row>> body_side(const BodyView& bodies, const Row& body) {
  return {gather(bodies.position, body),
          gather(bodies.predicted_velocity, body),
          gather(bodies.predicted_angular_velocity, body),
          gather(bodies.mean_velocity, body),
          gather(bodies.mean_angular_velocity, body),
          gather(bodies.inverse_mass, body),
          gather(bodies.contact_share, body),
          gather(bodies.inverse_inertia, body),
          rotation_matrix(gather(bodies.orientation, body))};
}

TALUS_HD inline ContactSide wall_side(const WallRecord& wall) {
  return {wall.rotation_centre,
          wall.velocity,
          wall.angular_velocity,
          wall.mean_velocity,
          wall.mean_angular_velocity,
          0,
          1,
          {},
          {}};
}

struct NoWorkRecord {
  static constexpr bool kEnabled = false;
};
struct WorkRecord {
  static constexpr bool kEnabled = true;
};

template <class Number>
struct BasicContactForces {
  BasicNormalDamping<Number> normal;
  Vector3<Number> damping;               // on a [N]
  BasicFrictionForces<Number> friction;  // on a
  Number effective_mass{};               // that an impulse along the normal meets [kg]
};
using ContactForces = BasicContactForces<Real>;

/// Work of the step that ends now, by the trapezoidal rule over the mean velocities: the same quadrature as the
/// integrator's, so that the ledger measures its error and adds none of its own.
struct StepWork {
  Real elastic = 0, damping = 0, friction = 0;  // done on the bodies [J]
  Real by_wall = 0;                             // done by side b's own motion on a [J]
};

template <class Friction>
TALUS_HD StepWork step_work(const ContactView& contacts, int c, const ElasticContact& elastic, const Vec3& torque_b,
                            const ContactForces& forces, const ContactSide& a, const ContactSide& b, Real time_step) {
  const Real half = time_step / 2;
  StepWork work;
  const Vec3 force = contacts.last_elastic_force[c] + elastic.force;
  const Real on_b =
      half * (dot(contacts.last_elastic_torque_b[c] + torque_b, b.mean_angular_velocity) - dot(force, b.mean_velocity));
  work.elastic = half * (dot(force, a.mean_velocity) +
                         dot(contacts.last_elastic_torque_a[c] + elastic.torque_a, a.mean_angular_velocity)) +
                 on_b;
  // The contact point moves: as an edge becomes a face, by much of the body's size in a few steps.
  const Vec3 last = contacts.point[c];
  const Vec3 velocity_b = b.mean_velocity_at(elastic.point),
             last_velocity_b = b.mean_velocity_at_start(last, time_step);
  const Vec3 slip = a.mean_velocity_at(elastic.point) - velocity_b;
  const Vec3 last_slip = a.mean_velocity_at_start(last, time_step) - last_velocity_b;
  const Vec3 last_damping = contacts.last_damping_force[c], last_friction = contacts.last_friction_force[c];
  work.damping = half * (dot(last_damping, last_slip) + dot(forces.damping, slip));
  work.friction = half * (dot(last_friction, last_slip) + dot(forces.friction.force, slip));
  work.by_wall = -on_b + half * (dot(last_damping + last_friction, last_velocity_b) +
                                 dot(forces.damping + forces.friction.force, velocity_b));
  if constexpr (Friction::kHasCouple) {
    const Vec3 couple = contacts.last_friction_couple[c] + forces.friction.couple;
    work.friction += half * dot(couple, a.mean_angular_velocity - b.mean_angular_velocity);
    work.by_wall += half * dot(couple, b.mean_angular_velocity);
  }
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

/// A contact on its orbit stores the energy of its depth; what else its force took is the dashpot's. `stored_before`:
/// at the end of the last step [J].
TALUS_HD inline void record_orbit(const ContactView& contacts, int c, const StepWork& work, Real stored_before,
                                  Real energy) {
  const Real loss = stored_before - energy - work.elastic;
  contacts.elastic_work[c] = energy;
  contacts.loss_normal[c] += loss;
  contacts.orbit_loss[c] += loss;
}

/// No force this step; the history ends.
template <class Damping, class Friction, class Record>
TALUS_HD void end_contact(const ContactView& contacts, int c, const ContactSide& a, const ContactSide& b,
                          Real time_step, [[maybe_unused]] bool is_damped) {
  if (contacts.depth[c] == 0) return;
  if constexpr (Record::kEnabled) {
    ElasticContact none;
    none.point = contacts.point[c];
    const StepWork work = step_work<Friction>(contacts, c, none, Vec3{}, ContactForces{}, a, b, time_step);
    [[maybe_unused]] const Real stored_before = contacts.elastic_work[c];
    record_work(contacts, c, work, 0, false, is_wall_kind(key_kind(contacts.key[c])));
    if constexpr (Damping::kHasOrbit)
      if (is_damped) {
        record_orbit(contacts, c, work, stored_before, 0);
        // A dashpot gives nothing: what it seems to have given shows as imbalance.
        if (contacts.orbit_loss[c] < 0) contacts.loss_normal[c] -= contacts.orbit_loss[c];
        contacts.orbit_loss[c] = 0;
      }
    contacts.last_elastic_force[c] = contacts.last_elastic_torque_a[c] = contacts.last_elastic_torque_b[c] = Vec3{};
    contacts.last_damping_force[c] = contacts.last_friction_force[c] = Vec3{};
    if constexpr (Friction::kHasCouple) contacts.last_friction_couple[c] = Vec3{};
  }
  Damping::forget(contacts, c);
  if constexpr (Friction::kEnabled) Friction::forget(contacts, c);
  contacts.force[c] = contacts.torque_a[c] = contacts.torque_b[c] = Vec3{};
  contacts.depth[c] = 0;
}

/// Friction of contact c from the sides' motion.
template <class Friction, class Row, class Number, class Patch>
TALUS_HD BasicFrictionForces<Number> friction_forces(const ContactView& contacts, const Row& c,
                                                     BasicFrictionContact<Number> contact,
                                                     const BasicContactSide<Number>& a,
                                                     const BasicContactSide<Number>& b, const Friction& friction,
                                                     const Patch& patch) {
  const Vector3<Number>& point = contact.elastic.point;
  contact.mean = {a.mean_velocity_at(point) - b.mean_velocity_at(point),
                  a.mean_angular_velocity - b.mean_angular_velocity};
  contact.predicted = {a.predicted_velocity_at(point) - b.predicted_velocity_at(point),
                       a.predicted_angular_velocity - b.predicted_angular_velocity};
  contact.mean_spin = (Number{} + Real(0.5)) * (a.mean_angular_velocity + b.mean_angular_velocity);
  return friction.apply(contacts, c, contact, patch);
}

/// Acceleration of approach, negative: centres that pass each other at a velocity part as they go [m/s2].
template <class Number>
TALUS_HD Number turning(const BasicElasticContact<Number>& elastic, const Vector3<Number>& velocity) {
  const Number along = dot(velocity, elastic.normal);
  return -elastic.curvature * (norm_squared(velocity) - along * along);
}

/// Forces of contact c, or of one a lane, besides the elastic one, which damping may refine. Not part of respond, nor
/// is write_contact, so that motion is the same with a record and without.
template <class Damping, class Friction, class Row, class Number, class Patch>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED BasicContactForces<Number> contact_forces(
    const ContactView& contacts, const Row& c, BasicElasticContact<Number>& elastic, const BasicContactSide<Number>& a,
    const BasicContactSide<Number>& b, const BasicPairProperties<Number>& pair, const Friction& friction,
    const Patch& patch, const Step& step, const Number& diameter) {
  const Vector3<Number> slip = a.predicted_velocity_at(elastic.point) - b.predicted_velocity_at(elastic.point);
  const Vector3<Number> mean_slip = a.mean_velocity_at(elastic.point) - b.mean_velocity_at(elastic.point);
  BasicContactForces<Number> forces;
  forces.effective_mass = 1 / (a.inverse_effective_mass(elastic.point, elastic.normal) +
                               b.inverse_effective_mass(elastic.point, elastic.normal));
  forces.normal = Damping::apply(
      contacts, c, elastic,
      BasicNormalImpact<Number>{pair, forces.effective_mass, dot(mean_slip, elastic.normal), dot(slip, elastic.normal),
                                turning(elastic, a.mean_velocity - b.mean_velocity), step});
  forces.damping = -forces.normal.force * elastic.normal;
  if constexpr (Friction::kEnabled)
    forces.friction =
        friction_forces(contacts, c,
                        BasicFrictionContact<Number>{elastic, pair, forces.normal.force, forces.effective_mass,
                                                     diameter, step.length, smaller(a.contact_share, b.contact_share)},
                        a, b, friction, patch);
  return forces;
}

template <class Number>
TALUS_HD Vector3<Number> elastic_torque_on_b(const BasicElasticContact<Number>& elastic,
                                             const BasicContactSide<Number>& a, const BasicContactSide<Number>& b) {
  return cross(b.centre - a.centre, elastic.force) - elastic.torque_a;
}

/// Forces on both sides, and what is kept of the contact, or of one a lane: those of walls are single.
template <class Friction, class Row, class Number>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED void write_contact(const ContactView& contacts, const Row& c,
                                                             const BasicElasticContact<Number>& elastic,
                                                             const BasicContactForces<Number>& forces,
                                                             const BasicContactSide<Number>& a,
                                                             const BasicContactSide<Number>& b, Real time_step,
                                                             const Number& diameter) {
  const Vector3<Number> at_point = forces.damping + forces.friction.force, force = elastic.force + at_point;
  Vector3<Number> torque_a = elastic.torque_a + cross(elastic.point - a.centre, at_point);
  Vector3<Number> torque_b = elastic_torque_on_b(elastic, a, b) - cross(elastic.point - b.centre, at_point);
  if constexpr (Friction::kHasCouple) {
    torque_a += forces.friction.couple;
    torque_b -= forces.friction.couple;
  }
  scatter(contacts.force, c, force);
  scatter(contacts.torque_a, c, torque_a);
  scatter(contacts.torque_b, c, torque_b);
  scatter(contacts.point, c, elastic.point);
  scatter(contacts.depth, c, elastic.depth);
  scatter(contacts.peak_overlap, c, larger(elastic.depth / diameter, gather(contacts.peak_overlap, c)));
  scatter(contacts.peak_rate, c, larger(elastic.stiffness / forces.effective_mass, gather(contacts.peak_rate, c)));
  if constexpr (std::is_same_v<Row, int>)
    if (is_wall_kind(key_kind(contacts.key[c]))) {
      contacts.wall_impulse[c] -= time_step * force;
      contacts.wall_angular_impulse[c] += time_step * torque_b;
    }
}

/// Work of a touching contact, before it is written.
template <class Damping, class Friction>
TALUS_HD void record_contact(const ContactView& contacts, int c, const ElasticContact& elastic,
                             const ContactForces& forces, const ContactSide& a, const ContactSide& b, Real time_step) {
  const Vec3 torque_b = elastic_torque_on_b(elastic, a, b);
  const StepWork work = step_work<Friction>(contacts, c, elastic, torque_b, forces, a, b, time_step);
  [[maybe_unused]] const Real stored_before = contacts.elastic_work[c];
  record_work(contacts, c, work, forces.friction.energy, true, is_wall_kind(key_kind(contacts.key[c])));
  if constexpr (Damping::kHasOrbit)
    if (forces.normal.is_orbit) record_orbit(contacts, c, work, stored_before, elastic.energy);
  contacts.last_elastic_force[c] = elastic.force;
  contacts.last_elastic_torque_a[c] = elastic.torque_a;
  contacts.last_elastic_torque_b[c] = torque_b;
  contacts.last_damping_force[c] = forces.damping;
  contacts.last_friction_force[c] = forces.friction.force;
  if constexpr (Friction::kHasCouple) contacts.last_friction_couple[c] = forces.friction.couple;
}

/// Completes a touching contact: damping, friction, forces on both sides, history, work.
template <class Damping, class Friction, class Record>
TALUS_HD void respond(const ContactView& contacts, int c, ElasticContact& elastic, const ContactSide& a,
                      const ContactSide& b, const PairProperties& pair, const Friction& friction,
                      const typename Friction::Patch& patch, const Step& step, Real diameter) {
  const ContactForces forces =
      contact_forces<Damping, Friction>(contacts, c, elastic, a, b, pair, friction, patch, step, diameter);
  if constexpr (Record::kEnabled) record_contact<Damping, Friction>(contacts, c, elastic, forces, a, b, step.length);
  write_contact<Friction>(contacts, c, elastic, forces, a, b, step.length, diameter);
}

}  // namespace dem_gpu
