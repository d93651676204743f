// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/normal_orbit.h"
#include "dem_gpu/contacts/normal_series.h"

namespace dem_gpu {

// A damping policy completes the elastic normal force so that the restitution asked for comes out:
//   apply(contacts, c, elastic, impact)   NormalDamping; may refine the elastic force
//   forget(contacts, c)                   ends its history

struct NormalDamping {
  Real force = 0;         // beside the elastic force, positive when repulsive [N]
  bool is_orbit = false;  // the elastic force has the dashpot's in it: over a whole step the two are one mean force
};

/// Depth of a contact that has just begun over the way of approach in a step, at most. Above 1 by the turn of the
/// normal during a step: bodies that touch deeper than they came were placed so. In single precision a first touch
/// within rounding goes unseen for a step.
inline constexpr Real kTouchMargin = local_tolerance(Real(1.1), Real(2));

struct Step {
  Real length;    // [s]; 0: the forces of a start, before any step
  bool is_first;  // after a start: contacts have given the half kick of its beginning only
};

/// What a damping policy sees of a touching contact besides the elastic force.
struct NormalImpact {
  const PairProperties& pair;
  Real effective_mass;   // that an impulse along the normal meets [kg]
  Real mean_speed;       // of approach over the step that ends now [m/s]
  Real predicted_speed;  // of approach at its end, the forces of its beginning taken as constant [m/s]
  Real turning;          // acceleration of approach as the normal turns under sliding centres [m/s2]
  Step step;             // that ends now
};

/// Dashpot beside the elastic force of Verlet, by the implicit midpoint rule over the step that the next full kick
/// spans. Its window begins at touch, where the force of flat faces jumps: restitution does not depend on where in a
/// step they touch. The whole normal force never pulls.
struct PointDamping {
  static constexpr bool kHasOrbit = false;

  TALUS_HD static NormalDamping apply(const ContactView& contacts, int c, const ElasticContact& elastic,
                                      const NormalImpact& impact) {
    const Real mass = impact.effective_mass, step = impact.step.length;
    if (!(step > 0)) return {};  // forces of a start, before any step
    const Real force = norm(elastic.force);
    const Real rate =
        dashpot(impact.pair.damping_ratio, mass, damped_stiffness(elastic.stiffness, force / elastic.depth)) / mass;
    const Real window = contacts.depth[c] == 0 ? step_of_touch(elastic.depth, impact) : step;
    const Real contact_before = -dot(contacts.force[c], elastic.normal) / mass;
    const Real by_others = 2 * (impact.predicted_speed - impact.mean_speed) / step + contact_before;
    const Real speed = (impact.mean_speed + window / 2 * (by_others - force / mass)) / (1 + rate * window / 2);
    return {std::max(mass * rate * speed * (window / step), -force)};
  }
  TALUS_HD static void forget(const ContactView&, int) {}

 private:
  /// From touch to half a step after the end of the step in which it fell [s].
  TALUS_HD static Real step_of_touch(Real depth, const NormalImpact& impact) {
    const Real step = impact.step.length;
    return depth <= kTouchMargin * step * impact.mean_speed ? step / 2 + depth / impact.mean_speed : step;
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
  const NormalAcceleration law{start.depth, start.elastic, start.damping, start.adhesion, Law::kExponent > 1};
  const Real rate = std::sqrt(Law::kExponent * start.elastic / start.depth);
  NormalOrbit orbit{law, start.depth, start.speed, start.acceleration};
  Real duration = step;
  if (is_first) duration += orbit.back_to_touch(step);
  orbit.advance(duration, orbit_substeps((rate + start.damping) * duration, is_first), is_first);
  return {orbit.kick, orbit.has_parted ? orbit.kick : orbit.shift / step};
}

template <class Law>
TALUS_HD NormalKick<Real> orbit_kick(const NormalStart<Real>& start, Real step, bool is_first) {
  NormalSeries<Law, Real> series;
  if (!is_first) {
    const NormalKick<Real> kick = series.advance(start, step);
    if (series.is_good()) return kick;
  }
  return orbit_in_substeps<Law>(start, step, is_first);
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
    const NormalAcceleration law{elastic.depth, (force + elastic.adhesion) / mass, damping, elastic.adhesion / mass,
                                 Law::kExponent > 1};
    const bool is_first = contacts.depth[c] == 0 && elastic.depth <= kTouchMargin * step * impact.mean_speed;
    Real by_others = 0, owed = contacts.owed_kick[c];
    if (!is_first) {
      const Real contact_before = -dot(contacts.force[c], elastic.normal) / mass;
      if (impact.step.is_first) owed = step / 2 * contact_before;
      by_others = 2 * (impact.predicted_speed - impact.mean_speed) / step + contact_before;
    }
    if (damping == 0 && elastic.adhesion == 0 && !law.is_hertz && rate * step < kFineStep) {
      const Real kick = elastic_kick(law, impact, is_first, by_others, contacts.owed_kick[c]);
      elastic.force = -mass * kick / step * elastic.normal;  // without a dashpot all of it is elastic
      return {};
    }
    const NormalStart<Real> start{elastic.depth,
                                  impact.mean_speed + step / 2 * by_others - owed,
                                  by_others + impact.turning,
                                  law.elastic,
                                  damping,
                                  law.adhesion};
    const NormalKick<Real> orbit = orbit_kick<Law>(start, step, is_first);
    contacts.owed_kick[c] = orbit.kick - orbit.mean;
    elastic.force = -mass * (owed + orbit.mean) / step * elastic.normal;
    if (damping == 0) return {};
    return {0, true};
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) { contacts.owed_kick[c] = 0; }

 private:
  /// Loss of approach speed in Verlet's next full kick [m/s]. Between touch and release Verlet is left alone: it is
  /// symplectic, so that contacts of several bodies keep their energy too. Its only loss of second order, where a step
  /// straddles touch or release, is taken away by the exact motion on the part in contact. For the linear spring only,
  /// whose rate is the same all through a contact; lone Hertz contacts and coarse steps fare better on their orbit.
  /// `owed`: in, of the last step; out, of this one.
  TALUS_HD static Real elastic_kick(const NormalAcceleration& law, const NormalImpact& impact, bool is_first,
                                    Real by_others, Real& owed) {
    const Real step = impact.step.length, depth = law.depth0, before = owed;
    const Real others = by_others + impact.turning;
    owed = 0;
    if (is_first) {
      NormalOrbit orbit{law, depth, impact.mean_speed, others};
      const Real touched = orbit.back_to_touch(step);
      NormalOrbit whole = orbit;
      orbit.advance(touched, kElasticSubsteps, true);
      const Real force = law(depth - orbit.shift, 0);
      if (depth - orbit.shift + step * (impact.mean_speed - orbit.kick - step / 2 * force) <= 0) {
        whole.advance(touched + step, kElasticSubsteps, true);
        if (whole.has_parted) return whole.kick;
      }
      owed = -orbit.shift / step;
      return orbit.kick + step / 2 * force + orbit.shift / step;
    }
    const Real force = law.elastic;
    const Real speed = impact.mean_speed - before + step / 2 * (by_others - force);
    if (depth + step * (speed + step / 2 * (others - force)) <= 0) {
      NormalOrbit orbit{law, depth, speed, others};
      orbit.advance(step, kElasticSubsteps, false);
      if (orbit.has_parted) return before + step / 2 * force + orbit.kick;
    }
    return before + step * force;
  }

  static constexpr int kElasticSubsteps = 4;
  static constexpr Real kFineStep = 0.2;  // of 1 / rate: 16 steps a contact
};

}  // namespace dem_gpu
