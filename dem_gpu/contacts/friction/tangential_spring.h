// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/friction/friction_contact.h"

namespace dem_gpu {

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

/// One tangential spring a contact, its stiffness in proportion to that of the normal contact.
struct SpringFriction {
  static constexpr bool kEnabled = true;
  static constexpr bool kHasCouple = false;
  using Patch = NoPatch;

  Real tangential_stiffness_ratio;  // tangential over normal stiffness [-]

  TALUS_HD FrictionForces apply(const ContactView& contacts, int c, const FrictionContact& contact, NoPatch) const {
    const Vec3 normal = contact.elastic.normal;
    const auto tangential = [&](const Vec3& v) { return v - dot(v, normal) * normal; };
    TangentialSpring spring{contacts.tangential_displacement[c], tangential_stiffness_ratio * contact.elastic.stiffness,
                            0};
    spring.damping = 2 * contact.pair.damping.ratio[0] * std::sqrt(contact.effective_mass * spring.stiffness);
    FrictionForces friction;
    friction.force = spring.force(normal, tangential(contact.mean.velocity), tangential(contact.predicted.velocity),
                                  contact.time_step, contact.pair.friction_coefficient * contact.normal_load());
    friction.energy = Real(0.5) * spring.stiffness * norm_squared(spring.displacement);
    contacts.tangential_displacement[c] = spring.displacement;
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) { contacts.tangential_displacement[c] = Vec3{}; }
};

}  // namespace dem_gpu
