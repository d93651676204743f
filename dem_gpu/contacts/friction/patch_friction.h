// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_columns.h"
#include "dem_gpu/contacts/contact_patch.h"
#include "dem_gpu/contacts/friction/friction_contact.h"
#include "dem_gpu/core/row_columns.h"

namespace dem_gpu {

/// The springs of a polyhedral contact, or of one a lane, world frame: one against slip, one against spin. With T the
/// patch's normals and P = I - T:
///   slip' = P v     force  = -k P slip          spin' = r T omega     couple = -k r T spin
/// so that the stored energy k/2 (|slip|^2 + |spin|^2) grows by the springs' work and nothing else: neither a patch
/// that changes shape or turns, nor a load that comes and goes, adds energy or lets a stuck contact creep.
template <class Number>
struct PatchSprings {
  Vector3<Number> slip, spin;  // [m]

  TALUS_HD Number squared(Real spin_share) const {
    return norm_squared(slip) + norm_squared(spin) / (spin_share * spin_share);
  }
  TALUS_HD void scale(const Number& factor) {
    slip *= factor;
    spin *= factor;
  }
  /// Follows the contact: the turn that takes the last normal to this one, and the bodies' mean spin about it.
  TALUS_HD void turn(const Vector3<Number>& last_normal, const Vector3<Number>& normal, const Number& angle) {
    // A normal that jumps is not one plane turning (a slot, where the force may point either way).
    constexpr Real kLeastCosine = Real(0.5);
    const Number cosine = dot(last_normal, normal);
    const auto is_turn = cosine > kLeastCosine;
    const Vector3<Number> axis = select(is_turn, cross(last_normal, normal), {});
    const Number tilt = select(is_turn, 1 / (1 + cosine), Number{});
    const Vector3<Number> half = (angle / 2) * normal;  // Cayley's rotation
    const Number share = 2 / (1 + norm_squared(half));
    const auto turned = [&](const Vector3<Number>& v) {
      const Vector3<Number> tilted = v + cross(axis, v) + tilt * cross(axis, cross(axis, v));
      const Vector3<Number> once = cross(half, tilted);
      return tilted + share * (once + cross(half, once));
    };
    slip = turned(slip);
    spin = turned(spin);
  }
};

/// Coulomb friction of a contact of polyhedra from its patch: a force at the contact point and a couple about the
/// patch's normals, under one limit (|force| / mu N)^2 + (|couple| / c mu N r)^2 <= 1. (A convex limit surface for a
/// patch in planar motion: Goyal, Ruina & Papadopoulos, Wear 143 (1991) 307-330; its ellipsoid: Howe & Cutkosky, Int.
/// J. Robot. Res. 15 (1996) 557-572.)
struct PatchFriction {
  static constexpr bool kEnabled = true;
  static constexpr bool kHasCouple = true;
  using Patch = ContactPatch;
  /// c: couple at which an evenly loaded square spins, over mu N r. 0.3826 L of the integral of |x| over L / sqrt(6);
  /// a line: 0.87, a disc: 0.94.
  static constexpr Real kSpinShare = Real(0.93);

  /// Damping ratio that a dashpot evaluated once a step stands.
  static constexpr Real kLargestRatio = 3;

  Real tangential_stiffness_ratio;  // tangential over normal stiffness [-]

  template <class Row, class Number>
  TALUS_HD BasicFrictionForces<Number> apply(const ContactView& contacts, const Row& c,
                                             const BasicFrictionContact<Number>& contact,
                                             const BasicContactPatch<Number>& patch) const {
    const Vector3<Number> normal = contact.elastic.normal;
    const Number one = Number{} + Real(1), time_step = Number{} + contact.time_step;
    // The same at every load and for every patch of a pair: a spring that softens with the load would not return what
    // it took. The area is that of a flat face as large as the body.
    const Number stiffness =
        tangential_stiffness_ratio * patch.stiffness_per_area * contact.diameter * contact.diameter;
    const Number load = larger(Number{}, patch.load + contact.damping);
    const Number limit = contact.pair.friction_coefficient * load / stiffness;  // [m]
    PatchSprings<Number> springs{gather(contacts.tangential_displacement, c), gather(contacts.turning_displacement, c)};
    springs.turn(gather(contacts.spring_normal, c), normal, time_step * dot(contact.mean_spin, normal));
    springs.slip += time_step * patch.slip(contact.mean.velocity);
    springs.spin += (time_step * patch.lever) * patch.spin(contact.mean.angular_velocity);
    const Number stretch = square_root(springs.squared(kSpinShare));
    springs.scale(select(stretch > limit, limit / stretch, one));
    scatter(contacts.tangential_displacement, c, springs.slip);
    scatter(contacts.turning_displacement, c, springs.spin);
    scatter(contacts.spring_normal, c, normal);

    const Number ratio = smaller(contact.pair.damping_ratio, Number{} + kLargestRatio);
    const Number damping = dashpot(ratio, contact.effective_mass, stiffness) / stiffness;  // [s]
    PatchSprings<Number> rate{damping * patch.slip(contact.predicted.velocity),
                              (damping * patch.lever) * patch.spin(contact.predicted.angular_velocity)};
    rate.scale(share_within(limit, springs, rate));
    BasicFrictionForces<Number> friction;
    friction.force = -stiffness * patch.slip(springs.slip + rate.slip);
    friction.couple = (-stiffness * patch.lever) * patch.spin(springs.spin + rate.spin);
    friction.energy = Real(0.5) * stiffness * (norm_squared(springs.slip) + norm_squared(springs.spin));
    return friction;
  }

  TALUS_HD static void forget(const ContactView& contacts, int c) {
    contacts.tangential_displacement[c] = contacts.turning_displacement[c] = contacts.spring_normal[c] = Vec3{};
  }

 private:
  /// Largest share, up to 1, of `rate` that keeps springs + share rate within the limit. All in metres of spring.
  template <class Number>
  TALUS_HD static Number share_within(const Number& limit, const PatchSprings<Number>& springs,
                                      const PatchSprings<Number>& rate) {
    const Number room = larger(Number{}, limit * limit - springs.squared(kSpinShare));
    const Number square = rate.squared(kSpinShare);
    const Number half = dot(springs.slip, rate.slip) + dot(springs.spin, rate.spin) / (kSpinShare * kSpinShare);
    return select(square + 2 * half <= room, Number{} + Real(1),
                  (square_root(half * half + square * room) - half) / square);
  }
};

}  // namespace dem_gpu
