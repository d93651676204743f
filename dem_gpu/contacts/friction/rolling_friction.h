// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/contacts/friction/sphere_friction.h"

namespace dem_gpu {

struct SpherePatch {
  Real effective_radius = 0;  // R* [m]
};

/// Rotational spring of rolling_friction: its length is the way that the surfaces roll, so that it is a tangential
/// spring of its own.
template <class Number>
struct RollingSpring {
  Number stiffness;  // [N/m]
  Number damping;    // [N s/m]
};

/// `stiffness`: of the normal contact [N/m].
template <class Number>
TALUS_HD RollingSpring<Number> rolling_spring(const Number& coefficient, const Number& stiffness,
                                              const Number& effective_mass) {
  // Iwashita & Oda's stiffness over mu_r^2; of critical damping what Ai et al. found enough for a sphere to come to
  // rest; moment of inertia of a rolling sphere about its contact over m R^2.
  constexpr Real kStiffness = 2.25, kDampingRatio = 0.3, kRollingMass = 1.4;
  const Number of_spring = kStiffness * coefficient * coefficient * stiffness;
  return {of_spring, 2 * kDampingRatio * square_root(kRollingMass * effective_mass * of_spring)};
}

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
    const Vec3& normal = contact.elastic.normal;
    const Real coefficient = contact.pair.rolling_friction;
    const RollingSpring<Real> spring = rolling_spring(coefficient, contact.elastic.stiffness, contact.effective_mass);
    const SphereSlip<Real> slip{normal,
                                contacts.depth[c] / contact.elastic.depth,
                                contact.time_step * dot(contact.mean_spin, normal),
                                patch.effective_radius * tangential_part(contact.mean.angular_velocity, normal),
                                patch.effective_radius * tangential_part(contact.predicted.angular_velocity, normal),
                                coefficient * contact.normal_load()};
    const SphereSpringForce<Real> rolling =
        spring_force<Law>(contacts.turning_displacement[c], slip, spring.stiffness, spring.damping, contact.time_step);
    friction.couple = patch.effective_radius * rolling.force;
    friction.energy += rolling.energy;
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) {
    contacts.tangential_displacement[c] = contacts.turning_displacement[c] = Vec3{};
  }
};

}  // namespace dem_gpu
