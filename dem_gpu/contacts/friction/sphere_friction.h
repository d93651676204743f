// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/friction/tangential_spring.h"

namespace dem_gpu {

/// What a spring in the plane of a sphere contact sees, of one contact or of several side by side.
template <class Number>
struct SphereSlip {
  Vector3<Number> normal;
  Number depth_before;              // over the depth now; 0 if new [-]
  Number twist;                     // of the spheres about the normal over the step [rad]
  Vector3<Number> mean, predicted;  // tangential velocity of a over b: moves the spring, is damped [m/s]
  Number limit;                     // of the force [N]
};

/// Force of such a spring and the energy left in it.
template <class Number>
struct SphereSpringForce {
  Vector3<Number> force;  // on a [N]
  Number energy;          // [J]
};

/// Square of the share of its length that a spring keeps when the normal contact has changed. Springs of a Hertz
/// contact stiffen with the depth: then they keep their force; as they soften they keep their length. Either way their
/// energy only falls. Thornton & Yin, Powder Technol. 65 (1991) 153-166; Walton, Mech. Mater. 16 (1993) 239-247.
/// `depth_before`: over the depth now.
template <class Law, class Number>
TALUS_HD Number length_kept_squared(const Number& depth_before) {
  const Number one = Number{} + Real(1);
  if constexpr (Law::kExponent > 1) return select(depth_before > Real(0), smaller(depth_before, one), one);
  return one;
}

/// The spring, as it was at the end of the last step, turns with the spin of the contact about its normal and moves
/// with the slip.
template <class Law, class Number>
TALUS_HD SphereSpringForce<Number> spring_force(Vector3<Number>& displacement, const SphereSlip<Number>& slip,
                                                const Number& stiffness, const Number& damping, Real time_step) {
  TangentialSprings<Number> spring{displacement + slip.twist * cross(slip.normal, displacement), stiffness, damping};
  SphereSpringForce<Number> found;
  found.force = spring.force(slip.normal, slip.mean, slip.predicted, time_step, slip.limit,
                             length_kept_squared<Law>(slip.depth_before));
  found.energy = Real(0.5) * stiffness * norm_squared(spring.displacement);
  displacement = spring.displacement;
  return found;
}

/// Dashpot of the tangential spring [N s/m]. `rate`: of its damping, 2 z sqrt(k_t / m) [1/s]. `contact_share`: of the
/// body that has more contacts, FrictionContact.
template <class Number>
TALUS_HD Number tangential_dashpot(const Number& rate, const Number& effective_mass, const Number& contact_share,
                                   Real time_step) {
  // The dashpot sees the slip half a step late: from the whole of it a step on, it would swing and add energy. It
  // takes half of it at most, and all that a body had in the last step together the whole.
  constexpr Real kShare = 0.5, kTangentialMass = Real(2) / 7;  // of a solid sphere that can turn, over its mass
  if (!(time_step > 0)) return Number{};
  const Number share = smaller(Number{} + kShare, contact_share);
  return smaller(rate, kTangentialMass / time_step * share) * effective_mass;
}

template <class Number>
TALUS_HD Vector3<Number> tangential_part(const Vector3<Number>& v, const Vector3<Number>& normal) {
  return v - dot(v, normal) * normal;
}

/// Coulomb friction of spheres. Linear law: a spring of constant stiffness. Hertz: 8 G* a, a = contact radius (Mindlin,
/// J. Appl. Mech. 16 (1949) 259-268, without partial slip); no more energy than went in comes out.
template <class Law>
struct SphereFriction {
  static constexpr bool kEnabled = true;
  static constexpr bool kHasCouple = false;
  using Patch = NoPatch;

  TALUS_HD FrictionForces apply(const ContactView& contacts, int c, const FrictionContact& contact, NoPatch) const {
    const Real stiffness = contact.pair.tangential_stiffness_ratio * contact.elastic.stiffness;
    const SphereSpringForce<Real> spring = spring_force<Law>(
        contacts.tangential_displacement[c], slip(contacts, c, contact), stiffness,
        tangential_dashpot(2 * contact.pair.sphere_damping * std::sqrt(stiffness / contact.effective_mass),
                           contact.effective_mass, contact.contact_share, contact.time_step),
        contact.time_step);
    FrictionForces friction;
    friction.force = spring.force;
    friction.energy = spring.energy;
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) { contacts.tangential_displacement[c] = Vec3{}; }

 private:
  TALUS_HD static SphereSlip<Real> slip(const ContactView& contacts, int c, const FrictionContact& contact) {
    const Vec3& normal = contact.elastic.normal;
    return {normal,
            contacts.depth[c] / contact.elastic.depth,
            contact.time_step * dot(contact.mean_spin, normal),
            tangential_part(contact.mean.velocity, normal),
            tangential_part(contact.predicted.velocity, normal),
            contact.pair.friction_coefficient * contact.normal_load()};
  }
};

}  // namespace dem_gpu
