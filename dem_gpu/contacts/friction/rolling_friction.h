// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/contacts/friction/sphere_friction.h"

namespace dem_gpu {

struct SpherePatch {
  Real effective_radius = 0;  // R* [m]
};

/// Coulomb friction and rolling resistance of spheres: a rotational spring with a dashpot, its couple at most
/// mu_r R* F_n. Ai, Chen, Rotter & Ooi, Powder Technol. 206 (2011) 269-282, model C, with the stiffness
/// 2.25 k_n (mu_r R*)^2 of its section 4 (after Iwashita & Oda).
template <class Law>
struct RollingFriction {
  static constexpr bool kEnabled = true;
  static constexpr bool kHasCouple = true;
  using Patch = SpherePatch;

  TALUS_HD FrictionForces apply(const ContactView& contacts, int c, const FrictionContact& contact,
                                const SpherePatch& patch) const {
    FrictionForces friction = SphereFriction<Law>{}.apply(contacts, c, contact, NoPatch{});
    const Vec3 normal = contact.elastic.normal;
    // The spring's length is the way that the surfaces roll, so that it is a tangential spring of its own.
    const auto rolled = [&](const Vec3& spin) { return patch.effective_radius * (spin - dot(spin, normal) * normal); };
    const Real coefficient = contact.pair.rolling_friction;
    TangentialSpring spring{carried_spring<Law>(contacts.turning_displacement[c], contacts.depth[c], contact),
                            kStiffness * coefficient * coefficient * contact.elastic.stiffness, 0};
    spring.damping = 2 * kDampingRatio * std::sqrt(kRollingMass * contact.effective_mass * spring.stiffness);
    const Vec3 force =
        spring.force(normal, rolled(contact.mean.angular_velocity), rolled(contact.predicted.angular_velocity),
                     contact.time_step, coefficient * contact.normal_load());
    friction.couple = patch.effective_radius * force;
    friction.energy += Real(0.5) * spring.stiffness * norm_squared(spring.displacement);
    contacts.turning_displacement[c] = spring.displacement;
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) {
    contacts.tangential_displacement[c] = contacts.turning_displacement[c] = Vec3{};
  }

 private:
  static constexpr Real kStiffness = 2.25;
  /// Of critical damping: the value that Ai et al. found enough for a sphere to come to rest.
  static constexpr Real kDampingRatio = 0.3;
  /// Moment of inertia of a rolling sphere about its contact over m R^2.
  static constexpr Real kRollingMass = 1.4;
};

}  // namespace dem_gpu
