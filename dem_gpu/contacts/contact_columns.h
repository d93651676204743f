// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/row_field.h"
#include "dem_gpu/core/vec3.h"
#include "dem_gpu/narrow_phase/separating_plane.h"

namespace dem_gpu {

/// Kinds of candidate pairs; the contact table is sorted by kind, so each kind is one range and one pass.
enum class ContactKind : int {
  polyhedron_polyhedron,
  sphere_sphere,
  sphere_polyhedron,  // a is the sphere
  polyhedron_wall,    // analytic wall
  polyhedron_object,  // convex volume object
  sphere_wall,
  sphere_object,
  polyhedron_mesh,  // triangle mesh
  sphere_mesh,
};
inline constexpr int kContactKinds = 9;

/// Key of a candidate pair: kind, a, b. Sorted keys make every sum over contacts run in one fixed order.
using ContactKey = std::uint64_t;
TALUS_HD inline ContactKey contact_key(ContactKind kind, int a, int b) {
  return (static_cast<ContactKey>(kind) << 60) | (static_cast<ContactKey>(a) << 30) | static_cast<ContactKey>(b);
}
TALUS_HD inline int key_body_a(ContactKey key) { return static_cast<int>((key >> 30) & 0x3fffffff); }
TALUS_HD inline int key_body_b(ContactKey key) { return static_cast<int>(key & 0x3fffffff); }
TALUS_HD inline ContactKind key_kind(ContactKey key) { return static_cast<ContactKind>(key >> 60); }
TALUS_HD inline bool is_wall_kind(ContactKind kind) { return kind >= ContactKind::polyhedron_wall; }
TALUS_HD inline bool is_mesh_kind(ContactKind kind) { return kind >= ContactKind::polyhedron_mesh; }

/// What every step reads and writes of a contact: one line of a cache. Its springs and owed kicks are there in scenes
/// without friction or spheres too: a line is fetched as a whole, and columns for each took a sixth more time (S1 box).
struct ContactRow {
  Vec3 force;                    // on a, world frame [N]
  Real depth = 0;                // largest depth, 0 if not touching [m]
  Vec3 tangential_displacement;  // with friction: of the spring, world frame [m]
  Real owed_kick = 0;            // with spheres: loss of approach speed of the last step that the next one takes [m/s]
};

/// Torques of a contact, each where a whole register begins.
struct ContactTorques {
  Vec3 torque_a;  // on a about a's centre, world frame [N m]
  Real none_a = 0;
  Vec3 torque_b;  // on b about b's centre (a wall's rotation centre), world frame [N m]
  Real none_b = 0;
};

/// Candidate pairs and what they carry from step to step, one entry each (n_contacts). Optional columns have length 0
/// where the scene has no use for them.
struct ContactColumns {
  DeviceVector<ContactKey> key;  // ascending
  DeviceVector<ContactRow> row;
  DeviceVector<ContactTorques> torques;
  DeviceVector<Vec3> point;                  // contact point, of two spheres with a ledger alone; world frame [m]
  DeviceVector<Real> peak_overlap;           // since last read: depth / diameter of the smaller body, see PeakLanes [-]
  DeviceVector<Real> peak_rate;              // since last read: stiffness / effective mass, see PeakLanes [1/s2]
  DeviceVector<char> is_truncated;           // a clipped polygon did not fit
  DeviceVector<int> cache_begin;             // first entry in separating, polyhedron pairs
  DeviceVector<SeparatingPlane> separating;  // one per pair of parts, all candidate pairs end to end

  // With pairs of polyhedra that wait.
  DeviceVector<Real> apart_until;  // sum of the bodies' travels up to which they cannot touch [m]

  // With meshes.
  DeviceVector<int> facet_begin;  // first entry in facet, n_contacts + 1; empty lists for other kinds
  DeviceVector<int> facet;        // facets that the body may touch, ascending, all lists end to end
  // With friction that resists turning.
  DeviceVector<Vec3> turning_displacement;  // of the rotational spring: lever x angle, world frame [m]

  // With friction of polyhedra.
  DeviceVector<Vec3> spring_normal;  // contact normal that the springs last followed, zero if new

  // With a ledger.
  DeviceVector<Real> elastic_work;           // recoverable, done against the elastic normal force since touch [J]
  DeviceVector<Real> orbit_loss;             // with spheres: to the dashpot since touch [J]
  DeviceVector<Real> tangential_energy;      // in the tangential spring [J]
  DeviceVector<Real> loss_normal;            // dissipated since last read [J]
  DeviceVector<Real> loss_shear;             // [J]
  DeviceVector<Real> wall_work;              // done by the wall on the body since last read [J]
  DeviceVector<Vec3> last_elastic_force;     // on a, at the end of the last step [N]
  DeviceVector<Vec3> last_elastic_torque_a;  // [N m]
  DeviceVector<Vec3> last_elastic_torque_b;  // [N m]
  DeviceVector<Vec3> last_damping_force;     // on a [N]
  DeviceVector<Vec3> last_friction_force;    // on a [N]
  DeviceVector<Vec3> last_friction_couple;   // on a, with friction that resists turning [N m]

  // With walls; zero for pairs of bodies.
  DeviceVector<Vec3> wall_impulse;          // on the wall since last read [N s]
  DeviceVector<Vec3> wall_angular_impulse;  // about its rotation centre [N m s]
};

struct ContactView {
  const ContactKey* key;
  ContactRow* row;
  ContactTorques* torques;
  RowField<&ContactRow::force> force;
  RowField<&ContactRow::depth> depth;
  RowField<&ContactRow::tangential_displacement> tangential_displacement;
  RowField<&ContactRow::owed_kick> owed_kick;
  RowField<&ContactTorques::torque_a> torque_a;
  RowField<&ContactTorques::torque_b> torque_b;
  Vec3* point;
  Real* peak_overlap;
  Real* peak_rate;
  char* is_truncated;
  int* cache_begin;
  SeparatingPlane* separating;
  Real* apart_until;
  const int* facet_begin;
  const int* facet;
  Vec3* turning_displacement;
  Vec3* spring_normal;
  Real* elastic_work;
  Real* orbit_loss;
  Real* tangential_energy;
  Real* loss_normal;
  Real* loss_shear;
  Real* wall_work;
  Vec3* last_elastic_force;
  Vec3* last_elastic_torque_a;
  Vec3* last_elastic_torque_b;
  Vec3* last_damping_force;
  Vec3* last_friction_force;
  Vec3* last_friction_couple;
  Vec3* wall_impulse;
  Vec3* wall_angular_impulse;
};

ContactView view(ContactColumns& columns);

/// Which optional columns a scene has.
struct ContactFeatures {
  bool has_friction = false;
  bool has_ledger = false;
  bool has_walls = false;
  bool has_polyhedra = false;
  bool has_friction_couples = false;
  bool has_spheres = false;
  bool has_meshes = false;
  bool has_waiting_pairs = false;  // of polyhedra, known to be apart for a while; not through periodic faces
};

/// Calls visitor(&ContactView::column) for each column that a contact in touch carries from step to step.
template <class Visitor>
TALUS_HD void visit_history(const ContactFeatures& features, Visitor&& visitor) {
  visitor(&ContactView::row);
  visitor(&ContactView::torques);
  visitor(&ContactView::point);
  if (features.has_friction_couples) visitor(&ContactView::turning_displacement);
  if (features.has_friction && features.has_polyhedra) visitor(&ContactView::spring_normal);
  if (!features.has_ledger) return;
  visitor(&ContactView::elastic_work);
  if (features.has_spheres) visitor(&ContactView::orbit_loss);
  visitor(&ContactView::tangential_energy);
  visitor(&ContactView::last_elastic_force);
  visitor(&ContactView::last_elastic_torque_a);
  visitor(&ContactView::last_elastic_torque_b);
  visitor(&ContactView::last_damping_force);
  visitor(&ContactView::last_friction_force);
  if (features.has_friction_couples) visitor(&ContactView::last_friction_couple);
}

/// All columns for `count` contacts, zero.
void resize_columns(ContactColumns& columns, int count, const ContactFeatures& features);

}  // namespace dem_gpu
