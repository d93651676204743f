// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_response.h"
#include "dem_gpu/contacts/pair_lanes.h"

namespace dem_gpu {

TALUS_HD inline void set_lane(RealLanes& lanes, int i, Real value) { lane(lanes, i) = value; }
TALUS_HD inline void set_lane(Vector3<RealLanes>& lanes, int i, const Vec3& value) {
  lane(lanes.x, i) = value.x;
  lane(lanes.y, i) = value.y;
  lane(lanes.z, i) = value.z;
}

TALUS_HD inline void set_lane(BasicElasticContact<RealLanes>& lanes, int i, const ElasticContact& contact) {
  set_lane(lanes.force, i, contact.force);
  set_lane(lanes.torque_a, i, contact.torque_a);
  set_lane(lanes.point, i, contact.point);
  set_lane(lanes.normal, i, contact.normal);
  set_lane(lanes.stiffness, i, contact.stiffness);
  set_lane(lanes.adhesion, i, contact.adhesion);
  set_lane(lanes.curvature, i, contact.curvature);
  set_lane(lanes.depth, i, contact.depth);
  set_lane(lanes.energy, i, contact.energy);
}
TALUS_HD inline ElasticContact lane(const BasicElasticContact<RealLanes>& lanes, int i) {
  return {lane(lanes.force, i),     lane(lanes.torque_a, i),  lane(lanes.point, i),
          lane(lanes.normal, i),    lane(lanes.stiffness, i), lane(lanes.adhesion, i),
          lane(lanes.curvature, i), lane(lanes.depth, i),     lane(lanes.energy, i)};
}

TALUS_HD inline void set_lane(BasicContactPatch<RealLanes>& lanes, int i, const ContactPatch& patch) {
  set_lane(lanes.normals.column_x, i, patch.normals.column_x);
  set_lane(lanes.normals.column_y, i, patch.normals.column_y);
  set_lane(lanes.normals.column_z, i, patch.normals.column_z);
  set_lane(lanes.load, i, patch.load);
  set_lane(lanes.lever, i, patch.lever);
  set_lane(lanes.stiffness_per_area, i, patch.stiffness_per_area);
}
TALUS_HD inline ContactPatch lane(const BasicContactPatch<RealLanes>& lanes, int i) {
  const BasicMat3<RealLanes>& normals = lanes.normals;
  return {{lane(normals.column_x, i), lane(normals.column_y, i), lane(normals.column_z, i)},
          lane(lanes.load, i),
          lane(lanes.lever, i),
          lane(lanes.stiffness_per_area, i)};
}
TALUS_HD inline void set_lane(NoPatch&, int, const NoPatch&) {}
TALUS_HD inline NoPatch lane(const NoPatch&, int) { return {}; }

TALUS_HD inline ContactForces lane(const BasicContactForces<RealLanes>& lanes, int i) {
  return {{lane(lanes.normal.force, i), lanes.normal.is_orbit},
          lane(lanes.damping, i),
          {lane(lanes.friction.force, i), lane(lanes.friction.couple, i), lane(lanes.friction.energy, i)},
          lane(lanes.effective_mass, i)};
}

template <class Patch>
struct PatchLanesOf {
  using Type = NoPatch;
};
template <>
struct PatchLanesOf<ContactPatch> {
  using Type = BasicContactPatch<RealLanes>;
};

/// Touching contacts of bodies put side by side, one a lane, to be answered together.
template <class Patch>
struct ContactLanes {
  PairRows rows;
  BasicElasticContact<RealLanes> elastic;
  typename PatchLanesOf<Patch>::Type patch;
  int count = 0;

  TALUS_HD bool is_full() const { return count == kRealLanes; }
  TALUS_HD void append(int c, int a, int b, const ElasticContact& contact, const Patch& of_contact) {
    rows.contact.row[count] = c;
    rows.a.row[count] = a;
    rows.b.row[count] = b;
    set_lane(elastic, count, contact);
    set_lane(patch, count, of_contact);
    ++count;
  }
  /// The last contact in all lanes that are left, which changes nothing.
  TALUS_HD void fill_up() {
    const int last = count - 1;
    while (!is_full()) append(rows.contact[last], rows.a[last], rows.b[last], lane(elastic, last), lane(patch, last));
  }
};

/// Completes touching contacts of bodies; there are none then.
template <class Damping, class Friction, class Record>
TALUS_HD TALUS_ONE_COPY TALUS_ALL_INLINED void respond_to_all(const ContactScene& scene, const Friction& friction,
                                                              ContactLanes<typename Friction::Patch>& touching) {
  const int count = touching.count;
  touching.fill_up();
  touching.count = 0;
  const BodyView& bodies = scene.bodies;
  const PairRows& rows = touching.rows;
  const BasicContactSide<RealLanes> a = body_side(bodies, rows.a), b = body_side(bodies, rows.b);
  const PairLanes pair = pair_lanes(scene, rows, [&](int i) { return bodies.material[rows.b[i]]; });
  const RealLanes diameter = smaller(gather(bodies.diameter, rows.a), gather(bodies.diameter, rows.b));
  const BasicContactForces<RealLanes> forces = contact_forces<Damping, Friction>(
      scene.contacts, rows.contact, touching.elastic, a, b, pair, friction, touching.patch, scene.step, diameter);
  if constexpr (Record::kEnabled)
    for (int i = 0; i < count; ++i)
      record_contact<Damping, Friction>(scene.contacts, rows.contact[i], lane(touching.elastic, i), lane(forces, i),
                                        body_side(bodies, rows.a[i]), body_side(bodies, rows.b[i]), scene.step.length);
  write_contact<Friction>(scene.contacts, rows.contact, touching.elastic, forces, a, b, scene.step.length, diameter);
}

}  // namespace dem_gpu
