// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/normal_orbit.h"
#include "dem_gpu/contacts/normal_series.h"
#include "dem_gpu/core/row_columns.h"

namespace dem_gpu {

// A damping policy completes the elastic normal force so that the restitution asked for comes out:
//   apply(contacts, c, elastic, impact)   NormalDamping; may refine the elastic force
//   forget(contacts, c)                   ends its history

template <class Number>
struct BasicNormalDamping {
  Number force{};         // beside the elastic force, positive when repulsive [N]
  bool is_orbit = false;  // the elastic force has the dashpot's in it: over a whole step the two are one mean force
};
using NormalDamping = BasicNormalDamping<Real>;

/// Depth of a contact that has just begun over the way of approach in a step, at most. Above 1 by the turn of the
/// normal during a step: bodies that touch deeper than they came were placed so. In single precision a first touch
/// within rounding goes unseen for a step.
inline constexpr Real kTouchMargin = local_tolerance(Real(1.1), Real(2));

struct Step {
  Real length;    // [s]; 0: the forces of a start, before any step
  bool is_first;  // after a start: contacts have given the half kick of its beginning only
};

/// What a damping policy sees of a touching contact besides the elastic force.
template <class Number>
struct BasicNormalImpact {
  const BasicPairProperties<Number>& pair;
  Number effective_mass;   // that an impulse along the normal meets [kg]
  Number mean_speed;       // of approach over the step that ends now [m/s]
  Number predicted_speed;  // of approach at its end, the forces of its beginning taken as constant [m/s]
  Number turning;          // acceleration of approach as the normal turns under sliding centres [m/s2]
  Step step;               // that ends now
};
using NormalImpact = BasicNormalImpact<Real>;

/// Dashpot beside the elastic force of Verlet, by the implicit midpoint rule over the step that the next full kick
/// spans. Its window begins at touch, where the force of flat faces jumps: restitution does not depend on where in a
/// step they touch. The whole normal force never pulls.
struct PointDamping {
  static constexpr bool kHasOrbit = false;

  template <class Row, class Number>
  TALUS_HD static BasicNormalDamping<Number> apply(const ContactView& contacts, const Row& c,
                                                   const BasicElasticContact<Number>& elastic,
                                                   const BasicNormalImpact<Number>& impact) {
    const Real step = impact.step.length;
    if (!(step > 0)) return {};  // forces of a start, before any step
    const Number mass = impact.effective_mass, force = norm(elastic.force);
    const Number rate =
        dashpot(impact.pair.damping_ratio, mass, damped_stiffness(elastic.stiffness, force / elastic.depth)) / mass;
    const auto is_new = gather(contacts.depth, c) == Real(0);
    const Number window = select(is_new, step_of_touch(elastic.depth, impact), Number{} + step);
    const Number contact_before = -dot(gather(contacts.force, c), elastic.normal) / mass;
    const Number by_others = 2 * (impact.predicted_speed - impact.mean_speed) / step + contact_before;
    const Number speed = (impact.mean_speed + window / 2 * (by_others - force / mass)) / (1 + rate * window / 2);
    return {larger(-force, mass * rate * speed * (window / step))};
  }
  TALUS_HD static void forget(const ContactView&, int) {}

 private:
  /// From touch to half a step after the end of the step in which it fell [s].
  template <class Number>
  TALUS_HD static Number step_of_touch(const Number& depth, const BasicNormalImpact<Number>& impact) {
    const Real step = impact.step.length;
    return select(depth <= kTouchMargin * step * impact.mean_speed, step / 2 + depth / impact.mean_speed,
                  Number{} + step);
  }
};

/// Sub-steps of an orbit. `progress`: duration times the rates of the motion [-].
TALUS_HD inline int orbit_substeps(Real progress, bool is_first) {
  // Share of 1 / (rates) that a sub-step spans: restitution is then right to 1e-5 at 20 steps a contact.
  constexpr Real kProgressPerSubstep = Real(0.1);
  constexpr int kFirstSubsteps = 6, kMostSubsteps = 512;
  const int needed = static_cast<int>(std::ceil(progress / kProgressPerSubstep));
  const int least = is_first ? kFirstSubsteps : 1;
  return std::min(std::max(needed, least), kMostSubsteps);
}

/// A step along the orbit in sub-steps: with touch or release in it, or a depth that changes much.
template <class Law>
TALUS_HD TALUS_ONE_COPY NormalKick<Real> orbit_in_substeps(const NormalStart<Real>& start, Real step, bool is_first) {
  const NormalAcceleration law{start.per_depth, start.elastic, start.damping, start.adhesion, Law::kExponent > 1};
  const Real rate = std::sqrt(Law::kExponent * start.elastic * start.per_depth);
  NormalOrbit orbit{law, start.depth, start.speed, start.acceleration};
  Real duration = step;
  if (is_first) duration += orbit.back_to_touch(step);
  orbit.advance(duration, orbit_substeps((rate + start.damping) * duration, is_first), is_first);
  return {orbit.kick, orbit.has_parted ? orbit.kick : orbit.shift / step};
}

/// What a sphere contact is at as a step ends, along its normal.
struct SphereMotion {
  NormalStart<Real> start;  // of the orbit; if the contact has just begun, by others: turning alone
  Real mean_speed;          // of approach over the step that ends now [m/s]
  Real owed;                // kick that the last step left to this one [m/s]
  bool is_first;            // it has just begun
  bool is_left_to_verlet;
};

/// What the next full kick of Verlet takes of the approach speed [m/s].
struct SphereKick {
  Real taken;
  Real owed;  // of it by the step after
};

/// Between touch and release Verlet is left alone where there is neither dashpot nor adhesion: it is symplectic, so
/// that contacts of several bodies keep their energy too. Its only loss of second order, where a step straddles touch
/// or release, is taken away by the exact motion on the part in contact. For the linear spring only, whose rate is the
/// same all through a contact; lone Hertz contacts and coarse steps fare better on their orbit.
TALUS_HD inline SphereKick elastic_kick(const SphereMotion& motion, Real step) {
  constexpr int kElasticSubsteps = 4;
  const NormalStart<Real>& start = motion.start;
  const NormalAcceleration law{start.per_depth, start.elastic, 0, 0, false};
  if (motion.is_first) {
    NormalOrbit orbit{law, start.depth, motion.mean_speed, start.acceleration};
    const Real touched = orbit.back_to_touch(step);
    NormalOrbit whole = orbit;
    orbit.advance(touched, kElasticSubsteps, true);
    const Real force = law(start.depth - orbit.shift, 0);
    if (start.depth - orbit.shift + step * (motion.mean_speed - orbit.kick - step / 2 * force) <= 0) {
      whole.advance(touched + step, kElasticSubsteps, true);
      if (whole.has_parted) return {whole.kick, 0};
    }
    return {orbit.kick + step / 2 * force + orbit.shift / step, -orbit.shift / step};
  }
  const Real force = law.elastic, speed = start.speed - step / 2 * force;
  if (start.depth + step * (speed + step / 2 * (start.acceleration - force)) <= 0) {
    NormalOrbit orbit{law, start.depth, speed, start.acceleration};
    orbit.advance(step, kElasticSubsteps, false);
    if (orbit.has_parted) return {motion.owed + step / 2 * force + orbit.kick, 0};
  }
  return {motion.owed + step * force, 0};
}

/// Share of 1 / rate that a step of elastic_kick spans, at most: 16 steps a contact.
inline constexpr Real kFineElasticStep = Real(0.2);

/// Whether elastic_kick has the contact rather than its orbit. `rate`: of the tangent stiffness [1/s].
template <class Law, class Number>
TALUS_HD auto is_left_to_verlet(const Number& damping, const Number& adhesion, const Number& rate, Real step) {
  return (damping == Real(0)) & (adhesion == Real(0)) & (rate * step < (Law::kExponent > 1 ? 0 : kFineElasticStep));
}

/// Of a contact that is neither let go nor taken by the series.
template <class Law>
TALUS_HD SphereKick substep_kick(const SphereMotion& motion, Real step) {
  if (motion.is_left_to_verlet) return elastic_kick(motion, step);
  const NormalKick<Real> orbit = orbit_in_substeps<Law>(motion.start, step, motion.is_first);
  return {motion.owed + orbit.mean, orbit.kick - orbit.mean};
}

template <class Law>
TALUS_HD TALUS_ONE_COPY SphereKick sphere_kick(const SphereMotion& motion, Real step) {
  if (!motion.is_first && !motion.is_left_to_verlet) {
    if (is_let_go(motion.start, step)) return {motion.owed, 0};
    NormalSeries<Law, Real> series;
    const NormalKick<Real> orbit = series.advance(motion.start, step);
    if (bits_of(series.is_good()) != 0) return {motion.owed + orbit.mean, orbit.kick - orbit.mean};
  }
  return substep_kick<Law>(motion, step);
}

/// The same dashpot for the power law F ~ depth^n of a sphere law, integrated within the step: restitution does not
/// depend on the step, nor on where in a step the spheres touch. Velocity Verlet gets the mean force that takes the
/// pair to where its orbit ends.
template <class Law>
struct OrbitDamping {
  static constexpr bool kHasOrbit = true;

  TALUS_HD static NormalDamping apply(const ContactView& contacts, int c, ElasticContact& elastic,
                                      const NormalImpact& impact) {
    const Real mass = impact.effective_mass, step = impact.step.length;
    if (!(step > 0)) return {};  // forces of a start, before any step: the elastic one alone
    const Real force = -dot(elastic.force, elastic.normal);
    const Real rate = std::sqrt(elastic.stiffness / mass), damping = 2 * impact.pair.sphere_damping * rate;
    const bool is_verlet = is_left_to_verlet<Law>(damping, elastic.adhesion, rate, step);
    const bool is_first = contacts.depth[c] == 0 && elastic.depth <= kTouchMargin * step * impact.mean_speed;
    Real by_others = 0, owed = contacts.owed_kick[c];
    if (!is_first) {
      const Real contact_before = -dot(contacts.force[c], elastic.normal) / mass;
      if (impact.step.is_first && !is_verlet) owed = step / 2 * contact_before;
      by_others = 2 * (impact.predicted_speed - impact.mean_speed) / step + contact_before;
    }
    const SphereMotion motion{
        {elastic.depth, 1 / elastic.depth, impact.mean_speed + step / 2 * by_others - owed, by_others + impact.turning,
         (force + elastic.adhesion) / mass, damping, elastic.adhesion / mass},
        impact.mean_speed,
        owed,
        is_first,
        is_verlet};
    const SphereKick kick = sphere_kick<Law>(motion, step);
    contacts.owed_kick[c] = kick.owed;
    // Without a dashpot all of it is elastic.
    elastic.force = -mass * kick.taken / step * elastic.normal;
    return {0, damping != 0};
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) { contacts.owed_kick[c] = 0; }
};

}  // namespace dem_gpu
