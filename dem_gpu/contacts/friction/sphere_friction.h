// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/contacts/friction/tangential_spring.h"

namespace dem_gpu {

/// Share of its length that a spring keeps when the normal contact has changed. Springs of a Hertz contact stiffen with
/// the depth: then they keep their force; as they soften they keep their length. Either way their energy only falls.
/// Thornton & Yin, Powder Technol. 65 (1991) 153-166; Walton, Mech. Mater. 16 (1993) 239-247.
template <class Law>
TALUS_HD Real length_kept(Real depth_before, Real depth) {
  if constexpr (Law::kExponent > 1) {
    if (depth_before > 0 && depth > depth_before) return std::sqrt(depth_before / depth);
  }
  return 1;
}

/// Spring as it was at the end of the last step, turned with the spin of the contact about its normal.
template <class Law>
TALUS_HD Vec3 carried_spring(const Vec3& displacement, Real depth_before, const FrictionContact& contact) {
  const Vec3& normal = contact.elastic.normal;
  const Real twist = contact.time_step * dot(contact.mean_spin, normal);
  return length_kept<Law>(depth_before, contact.elastic.depth) * (displacement + twist * cross(normal, displacement));
}

/// Coulomb friction of spheres. Linear law: a spring of constant stiffness. Hertz: 8 G* a, a = contact radius (Mindlin,
/// J. Appl. Mech. 16 (1949) 259-268, without partial slip); no more energy than went in comes out.
template <class Law>
struct SphereFriction {
  static constexpr bool kEnabled = true;
  static constexpr bool kHasCouple = false;
  using Patch = NoPatch;

  TALUS_HD FrictionForces apply(const ContactView& contacts, int c, const FrictionContact& contact, NoPatch) const {
    const Vec3 normal = contact.elastic.normal;
    const auto tangential = [&](const Vec3& v) { return v - dot(v, normal) * normal; };
    TangentialSpring spring{carried_spring<Law>(contacts.tangential_displacement[c], contacts.depth[c], contact),
                            contact.pair.tangential_stiffness_ratio * contact.elastic.stiffness, 0};
    spring.damping = std::min(2 * contact.pair.sphere_damping * std::sqrt(contact.effective_mass * spring.stiffness),
                              largest_dashpot(contact));
    FrictionForces friction;
    friction.force = spring.force(normal, tangential(contact.mean.velocity), tangential(contact.predicted.velocity),
                                  contact.time_step, contact.pair.friction_coefficient * contact.normal_load());
    friction.energy = Real(0.5) * spring.stiffness * norm_squared(spring.displacement);
    contacts.tangential_displacement[c] = spring.displacement;
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) { contacts.tangential_displacement[c] = Vec3{}; }

 private:
  /// The dashpot sees the slip half a step late: from the whole of it a step on, it would swing and add energy. It
  /// takes half of it at most [N s/m].
  TALUS_HD static Real largest_dashpot(const FrictionContact& contact) {
    constexpr Real kShare = 0.5, kTangentialMass = Real(2) / 7;  // of a solid sphere that can turn, over its mass
    return contact.time_step > 0 ? kShare * kTangentialMass * contact.effective_mass / contact.time_step : 0;
  }
};

}  // namespace dem_gpu
