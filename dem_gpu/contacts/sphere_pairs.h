// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/friction/rolling_friction.h"
#include "dem_gpu/contacts/normal_damping.h"
#include "dem_gpu/contacts/pair_lanes.h"
#include "dem_gpu/contacts/sphere_rows.h"
#include "dem_gpu/core/lanes.h"

namespace dem_gpu {

// Touching pairs of spheres side by side, or of spheres and walls. The normal goes through the centres of spheres, so
// that elastic forces turn nothing, an impulse along it meets 1 / (1/m_a + 1/m_b), and the torques of friction are the
// two levers times normal x force.

/// Where and how deep a sphere touches another, or a wall.
struct SphereTouch {
  Vector3<RealLanes> normal;   // from a to b
  RealLanes curvature;         // 1 / distance of the centres, 0 at a wall [1/m]
  RealLanes depth;             // [m]
  RealLanes depth_before;      // at the end of the last step [m]
  RealLanes inverse_depth;     // [1/m]
  RealLanes lever_a, lever_b;  // from the centres to the contact point, along the normal; 0 of a wall [m]
  RealLanes effective_radius;  // [m]

  TALUS_HD static SphereTouch of(const SphereLanes& a, const SphereLanes& b, const RealLanes& depth_before) {
    const Vector3<RealLanes> offset = b.position() - a.position();
    SphereTouch touch;
    const RealLanes distance = norm(offset);
    const auto is_apart = distance > Real(0);  // spheres on one spot part along z
    touch.curvature = select(is_apart, Real(1) / distance, RealLanes{});
    touch.normal = touch.curvature * offset;
    touch.normal.z = select(is_apart, touch.normal.z, RealLanes{} + Real(1));
    // Rounding may leave a pair that touches by its squares without any.
    constexpr Real kLeast = std::numeric_limits<Real>::epsilon() / 4;
    touch.depth = larger(a.radius() - (distance - b.radius()), kLeast * a.radius());
    touch.depth_before = depth_before;
    touch.inverse_depth = Real(1) / touch.depth;
    touch.lever_a = a.radius() - Real(0.5) * touch.depth;
    touch.lever_b = b.radius() - Real(0.5) * touch.depth;
    touch.effective_radius = a.radius() * b.radius() / (a.radius() + b.radius());
    return touch;
  }
  /// At a wall that far from the centre.
  TALUS_HD static SphereTouch of_wall(const SphereLanes& a, const Vector3<RealLanes>& into_wall,
                                      const RealLanes& distance, const RealLanes& depth_before) {
    SphereTouch touch;
    touch.curvature = touch.lever_b = RealLanes{};
    touch.normal = into_wall;
    touch.depth = a.radius() - distance;
    touch.depth_before = depth_before;
    touch.inverse_depth = Real(1) / touch.depth;
    touch.lever_a = distance + Real(0.5) * touch.depth;
    touch.effective_radius = a.radius();
    return touch;
  }
};

/// Of a relative to b: of the centres, of the surfaces at the contact point (tangential part) and of turning; mean spin
/// of both about the normal [m/s], [rad/s].
struct SphereVelocities {
  Vector3<RealLanes> relative, slip, spin;
  RealLanes twist_rate;

  TALUS_HD static SphereVelocities of(const Vector3<RealLanes>& relative, const Vector3<RealLanes>& spin_a,
                                      const Vector3<RealLanes>& spin_b, const SphereTouch& touch) {
    SphereVelocities found;
    found.relative = relative;
    found.slip =
        tangential_part(relative, touch.normal) + cross(touch.lever_a * spin_a + touch.lever_b * spin_b, touch.normal);
    found.spin = spin_a - spin_b;
    found.twist_rate = Real(0.5) * dot(spin_a + spin_b, touch.normal);
    return found;
  }
};

/// What a touching contact becomes.
struct SphereResponse {
  RealLanes stiffness, inverse_mass, effective_mass, adhesion;
  RealLanes rate;                       // root of stiffness / effective mass [1/s]
  RealLanes energy;                     // stored elastic energy of this depth [J]
  RealLanes push;                       // mean force along the normal, positive when repulsive [N]
  RealLanes owed;                       // kick left to the next step [m/s]
  Vector3<RealLanes> friction, couple;  // on a [N], [N m]
  RealLanes tangential_energy;          // in the springs [J]
  Vector3<RealLanes> sliding, rolling;  // lengths of the springs [m]
  RealLanes contact_share;              // of the body that has more contacts, BodyColumns [-]
  RealLanes diameter;                   // of the smaller sphere [m]
};

/// What the last step left of a contact.
struct LastContact {
  Quad<RealLanes> force_depth, spring_owed;

  TALUS_HD static LastContact of(const ContactScene& scene, const PairRows& rows) {
    return {gather_quad(scene.contacts.row, rows.contact, 0), gather_quad(scene.contacts.row, rows.contact, 1)};
  }
};

/// The push along the normal: by series for all, by sub-steps for those lanes that need them.
template <class Law>
TALUS_HD void find_push(const ContactScene& scene, const LastContact& last, const SphereTouch& touch,
                        const PairLanes& pair, const SphereVelocities& mean, const SphereVelocities& predicted,
                        RealLanes force, SphereResponse& response) {
  const Real step = scene.step.length;
  const RealLanes& inverse_mass = response.inverse_mass;
  const RealLanes mean_speed = dot(mean.relative, touch.normal);
  const RealLanes turning = -touch.curvature * (norm_squared(mean.relative) - mean_speed * mean_speed);
  const RealLanes damping = Real(2) * pair.sphere_damping * response.rate;
  const auto is_verlet = is_left_to_verlet<Law>(damping, response.adhesion, response.rate, step);
  const auto is_first = (touch.depth_before == Real(0)) & (touch.depth <= kTouchMargin * step * mean_speed);
  RealLanes owed = last.spring_owed.number;
  const RealLanes contact_before = -dot(last.force_depth.vector, touch.normal) * inverse_mass;
  if (scene.step.is_first) owed = select(is_first | is_verlet, owed, step / 2 * contact_before);
  const RealLanes by_others =
      select(is_first, RealLanes{}, (2 / step) * (dot(predicted.relative, touch.normal) - mean_speed) + contact_before);
  const NormalStart<RealLanes> start{touch.depth,
                                     touch.inverse_depth,
                                     mean_speed + step / 2 * by_others - owed,
                                     by_others + turning,
                                     force * inverse_mass,
                                     damping,
                                     response.adhesion * inverse_mass};
  NormalSeries<Law, RealLanes> series;
  const NormalKick<RealLanes> orbit = series.advance(start, step);
  const auto is_pressed = !is_let_go(start, step);
  RealLanes taken = owed + select(is_pressed, orbit.mean, RealLanes{});
  response.owed = select(is_pressed, orbit.kick - orbit.mean, RealLanes{});
  const unsigned is_other = (bits_of(is_pressed) & ~bits_of(series.is_good())) | bits_of(is_first) | bits_of(is_verlet);
  for (int i = 0; i < kRealLanes; ++i) {
    if ((is_other >> i & 1) == 0) continue;
    const SphereMotion motion{
        {lane(start.depth, i), lane(start.per_depth, i), lane(start.speed, i), lane(start.acceleration, i),
         lane(start.elastic, i), lane(start.damping, i), lane(start.adhesion, i)},
        lane(mean_speed, i),
        lane(owed, i),
        (bits_of(is_first) >> i & 1) != 0,
        (bits_of(is_verlet) >> i & 1) != 0};
    const SphereKick kick = substep_kick<Law>(motion, step);
    lane(taken, i) = kick.taken;
    lane(response.owed, i) = kick.owed;
  }
  response.push = response.effective_mass * taken * (1 / step);
}

template <class Law, class Friction>
TALUS_HD void find_friction(const ContactScene& scene, const PairRows& rows, const LastContact& last,
                            const SphereTouch& touch, const PairLanes& pair, const SphereVelocities& mean,
                            const SphereVelocities& predicted, SphereResponse& response) {
  const Real step = scene.step.length;
  // What presses the surfaces together. The mean force over a step may pull, to make up for the step before.
  const RealLanes load = larger(RealLanes{}, response.push + response.adhesion);
  const RealLanes stiffness = pair.tangential_stiffness_ratio * response.stiffness;
  SphereSlip<RealLanes> slip{touch.normal,           touch.depth_before * touch.inverse_depth,
                             step * mean.twist_rate, mean.slip,
                             predicted.slip,         pair.friction_coefficient * load};
  response.sliding = last.spring_owed.vector;
  const SphereSpringForce<RealLanes> sliding =
      spring_force<Law>(response.sliding, slip, stiffness,
                        tangential_dashpot(Real(2) * pair.sphere_tangential_damping * response.rate,
                                           response.effective_mass, response.contact_share, step),
                        step);
  response.friction = sliding.force;
  response.tangential_energy = sliding.energy;
  if constexpr (Friction::kHasCouple) {
    const RollingSpring<RealLanes> spring =
        rolling_spring(pair.rolling_friction, response.stiffness, response.effective_mass);
    slip.mean = touch.effective_radius * tangential_part(mean.spin, touch.normal);
    slip.predicted = touch.effective_radius * tangential_part(predicted.spin, touch.normal);
    slip.limit = pair.rolling_friction * load;
    response.rolling = gather(scene.contacts.turning_displacement, rows.contact);
    const SphereSpringForce<RealLanes> rolling =
        spring_force<Law>(response.rolling, slip, spring.stiffness, spring.damping, step);
    response.couple = touch.effective_radius * rolling.force;
    response.tangential_energy += rolling.energy;
  }
}

/// Forces of a contact whose `response` has the two sides' inverse mass, diameter and contact share.
template <class Law, class Friction>
TALUS_HD void find_forces(const Law& law, const ContactScene& scene, const PairRows& rows, const LastContact& last,
                          const SphereTouch& touch, const PairLanes& pair, const SphereVelocities& mean,
                          const SphereVelocities& predicted, SphereResponse& response) {
  response.effective_mass = Real(1) / response.inverse_mass;
  response.stiffness = law.tangent_stiffness(touch.depth, touch.effective_radius, pair.effective_modulus);
  response.rate = square_root(response.stiffness * response.inverse_mass);
  const RealLanes force = law.normal_force(touch.depth, touch.effective_radius, pair.effective_modulus);
  response.energy = force * touch.depth * (1 / (Law::kExponent + 1));
  response.adhesion = RealLanes{};
  if constexpr (Law::kIsAdhesive) {
    response.adhesion = Law::attraction(pair.adhesion, touch.effective_radius);
    response.energy -= response.adhesion * touch.depth;
  }
  response.push = force - response.adhesion;
  if (scene.step.length > 0)
    find_push<Law>(scene, last, touch, pair, mean, predicted, force, response);
  else  // forces of a start, before any step: the elastic one alone
    response.owed = last.spring_owed.number;
  if constexpr (Friction::kEnabled)
    find_friction<Law, Friction>(scene, rows, last, touch, pair, mean, predicted, response);
}

/// Not part of a kernel, nor is write_spheres, so that motion is the same with a work record and without.
template <class Law, class Friction>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED void respond_to_touch(const Law& law, const ContactScene& scene,
                                                                const SphereRow* spheres, const PairRows& rows,
                                                                SphereTouch& touch, SphereResponse& response) {
  const SphereLanes a = SphereLanes::of(spheres, rows.a), b = SphereLanes::of(spheres, rows.b);
  const LastContact last = LastContact::of(scene, rows);
  touch = SphereTouch::of(a, b, last.force_depth.number);
  const SphereVelocities mean =
      SphereVelocities::of(a.mean_velocity() - b.mean_velocity(), a.mean_spin(), b.mean_spin(), touch);
  const SphereVelocities predicted = SphereVelocities::of(a.predicted_velocity() - b.predicted_velocity(),
                                                          a.predicted_spin.vector, b.predicted_spin.vector, touch);
  response.diameter = smaller(a.diameter(), b.diameter());
  response.contact_share = smaller(a.contact_share(), b.contact_share());
  response.inverse_mass = a.inverse_mass() + b.inverse_mass();
  const PairLanes pair = pair_lanes(scene, rows, [&](int i) { return scene.bodies.material[rows.b[i]]; });
  find_forces<Law, Friction>(law, scene, rows, last, touch, pair, mean, predicted, response);
}

/// The worst of a range of contacts: the overlap where it is, so that a message names those bodies; of the rates the
/// largest of all is read, whichever contact has it.
struct PeakLanes {
  Real overlap = 0;
  int contact = 0;  // that has it
  RealLanes rate{};

  TALUS_HD void take(const PairRows& rows, const SphereTouch& touch, const SphereResponse& response) {
    for (unsigned worse = bits_of(touch.depth > overlap * response.diameter); worse != 0; worse &= worse - 1) {
      const int i = lowest_bit(worse);
      const Real in_lane = lane(touch.depth, i) / lane(response.diameter, i);
      if (in_lane <= overlap) continue;
      overlap = in_lane;
      contact = rows.contact[i];
    }
    rate = larger(rate, response.stiffness * response.inverse_mass);
  }
  /// `first`: contact of the range.
  TALUS_HD void keep(const ContactView& contacts, int first) const {
    Real& peak_overlap = contacts.peak_overlap[contact];
    peak_overlap = larger(peak_overlap, overlap);
    Real& peak_rate = contacts.peak_rate[first];
    for (int i = 0; i < kRealLanes; ++i) peak_rate = larger(peak_rate, lane(rate, i));
  }
};

/// Lane i of a contact as the work record sees it.
template <class Friction>
TALUS_HD void lane_of(int i, const SphereTouch& touch, const SphereResponse& response, const Vec3& centre_a,
                      ElasticContact& elastic, ContactForces& forces) {
  elastic.normal = lane(touch.normal, i);
  elastic.force = -lane(response.push, i) * elastic.normal;
  elastic.point = centre_a + lane(touch.lever_a, i) * elastic.normal;
  elastic.energy = lane(response.energy, i);
  if constexpr (Friction::kEnabled) forces.friction.force = lane(response.friction, i);
  if constexpr (Friction::kEnabled) forces.friction.energy = lane(response.tangential_energy, i);
  if constexpr (Friction::kHasCouple) forces.friction.couple = lane(response.couple, i);
}

template <class Friction>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED void write_spheres(const ContactScene& scene, const PairRows& rows,
                                                             const SphereTouch& touch, const SphereResponse& response) {
  const ContactView& contacts = scene.contacts;
  const RowLanes& c = rows.contact;
  Vector3<RealLanes> force = -response.push * touch.normal, sliding;
  if constexpr (Friction::kEnabled) {
    force += response.friction;
    sliding = response.sliding;
    const Vector3<RealLanes> turning = cross(touch.normal, response.friction);
    Vector3<RealLanes> torque_a = touch.lever_a * turning, torque_b = touch.lever_b * turning;
    if constexpr (Friction::kHasCouple) {
      torque_a += response.couple;
      torque_b -= response.couple;
      scatter(contacts.turning_displacement, c, response.rolling);
    }
    scatter_quad(contacts.torques, c, 0, {torque_a, RealLanes{}});
    scatter_quad(contacts.torques, c, 1, {torque_b, RealLanes{}});
  }
  scatter_quad(contacts.row, c, 0, {force, touch.depth});
  scatter_quad(contacts.row, c, 1, {sliding, response.owed});
}

}  // namespace dem_gpu
