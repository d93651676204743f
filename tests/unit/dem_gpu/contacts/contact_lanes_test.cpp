// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "dem_gpu/contacts/friction/no_friction.h"
#include "dem_gpu/contacts/friction/patch_friction.h"
#include "dem_gpu/narrow_phase/patch_sums.h"
#include "tests/support/dem_scenes.h"

namespace {

using namespace test_support;
using dem_gpu::ContactPatch;
using dem_gpu::ContactScene;
using dem_gpu::ElasticContact;
using dem_gpu::kRealLanes;
using dem_gpu::NoFriction;
using dem_gpu::NoPatch;
using dem_gpu::NoWorkRecord;
using dem_gpu::PatchFriction;
using dem_gpu::PointDamping;
using dem_gpu::Quaternion;
using dem_gpu::WorkRecord;

constexpr int kBodies = 7, kMaterials = 2;

/// Random bodies of 20 mm, the last one fixed.
struct Bodies {
  std::vector<int> material;
  std::vector<Real> inverse_mass, diameter, contact_share;
  std::vector<Vec3> inverse_inertia, position, predicted_velocity, predicted_spin, mean_velocity, mean_spin;
  std::vector<Quaternion> orientation;

  explicit Bodies(std::mt19937& random) {
    std::uniform_real_distribution<Real> share(0.5, 1);
    for (int i = 0; i < kBodies; ++i) {
      const Real movable = i + 1 < kBodies ? 1 : 0;
      material.push_back(i % kMaterials);
      inverse_mass.push_back(movable * 50 * share(random));
      diameter.push_back(0.02 * share(random));
      contact_share.push_back(share(random));
      inverse_inertia.push_back(movable * Vec3{1e6 * share(random), 1e6 * share(random), 1e6 * share(random)});
      position.push_back(0.01 * random_direction(random));
      mean_velocity.push_back(0.1 * random_direction(random));
      predicted_velocity.push_back(mean_velocity.back() + 0.01 * random_direction(random));
      mean_spin.push_back(10 * random_direction(random));
      predicted_spin.push_back(mean_spin.back() + random_direction(random));
      orientation.push_back(dem_gpu::axis_angle(random_direction(random), 3 * share(random)));
    }
  }
  dem_gpu::BodyView view() {
    dem_gpu::BodyView bodies{};
    bodies.count = kBodies;
    bodies.material = material.data();
    bodies.inverse_mass = inverse_mass.data();
    bodies.inverse_inertia = inverse_inertia.data();
    bodies.diameter = diameter.data();
    bodies.contact_share = contact_share.data();
    bodies.position = position.data();
    bodies.orientation = orientation.data();
    bodies.predicted_velocity = predicted_velocity.data();
    bodies.predicted_angular_velocity = predicted_spin.data();
    bodies.mean_velocity = mean_velocity.data();
    bodies.mean_angular_velocity = mean_spin.data();
    return bodies;
  }
};

/// Columns of Reals and of vectors that a contact is known by.
struct Contacts {
  std::vector<dem_gpu::ContactKey> key;
  std::vector<dem_gpu::ContactRow> row;
  std::vector<dem_gpu::ContactTorques> torques;
  std::vector<std::vector<Real>> numbers;
  std::vector<std::vector<Vec3>> vectors;

  dem_gpu::ContactView view() {
    using View = dem_gpu::ContactView;
    dem_gpu::ContactView contacts{};
    contacts.key = key.data();
    contacts.row = row.data();
    contacts.force = {row.data()};
    contacts.depth = {row.data()};
    contacts.tangential_displacement = {row.data()};
    contacts.torque_a = {torques.data()};
    contacts.torque_b = {torques.data()};
    constexpr Real* View::*kNumbers[] = {&View::peak_overlap,      &View::peak_rate,   &View::elastic_work,
                                         &View::tangential_energy, &View::loss_normal, &View::loss_shear};
    constexpr Vec3* View::*kVectors[] = {&View::point,
                                         &View::turning_displacement,
                                         &View::spring_normal,
                                         &View::last_elastic_force,
                                         &View::last_elastic_torque_a,
                                         &View::last_elastic_torque_b,
                                         &View::last_damping_force,
                                         &View::last_friction_force,
                                         &View::last_friction_couple};
    numbers.resize(std::size(kNumbers), std::vector<Real>(key.size()));
    vectors.resize(std::size(kVectors), std::vector<Vec3>(key.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) contacts.*kNumbers[i] = numbers[i].data();
    for (std::size_t i = 0; i < vectors.size(); ++i) contacts.*kVectors[i] = vectors[i].data();
    return contacts;
  }
  std::vector<std::vector<Vec3>> all_vectors() const {
    std::vector<std::vector<Vec3>> all = vectors;
    all.resize(all.size() + 4);
    for (std::size_t c = 0; c < key.size(); ++c) {
      const std::size_t first = vectors.size();
      all[first].push_back(row[c].force);
      all[first + 1].push_back(row[c].tangential_displacement);
      all[first + 2].push_back(torques[c].torque_a);
      all[first + 3].push_back(torques[c].torque_b);
    }
    return all;
  }
};

/// Contacts in every state there is, some of them several times.
struct RandomContacts {
  std::mt19937 random{11};
  Bodies bodies{random};
  Contacts contacts;
  std::vector<ElasticContact> elastic;
  std::vector<ContactPatch> patch;
  std::vector<dem_gpu::PairProperties> pairs;

  explicit RandomContacts(int count) {
    for (const Real damping : {0.1, 0.5, 0.5, 4.0}) pairs.push_back({damping, 0.3 + damping / 10});
    for (int c = 0; c < count; ++c) add(c);
  }
  void add(int c) {
    const int a = c % (kBodies - 2), b = kBodies - 1 - c / 2 % 2;
    const Vec3 normal = random_direction(random), other = random_direction(random);
    const bool is_new = c % 5 == 0, slides = c % 5 == 1, jumps = c % 5 == 2, has_no_patch = c % 7 == 3;
    const Real load = 10 + c;
    elastic.push_back({-load * normal, 0.01 * random_direction(random), 0.01 * random_direction(random), normal, 1e5});
    elastic.back().depth = is_new && c % 2 == 0 ? 1e-9 : 1e-4;
    dem_gpu::Mat3 normals{{}, {}, {}};
    if (!has_no_patch)
      dem_gpu::add_outer_product(normals, 0.7, normal), dem_gpu::add_outer_product(normals, 0.3, other);
    patch.push_back({normals, has_no_patch ? 0 : load, has_no_patch ? 0 : 0.004, 1e9});
    contacts.key.push_back(dem_gpu::contact_key(dem_gpu::ContactKind::polyhedron_polyhedron, a, b));
    contacts.row.emplace_back();
    contacts.torques.emplace_back();
    contacts.view();
    for (auto& column : contacts.numbers) column.resize(contacts.key.size(), 1e-3);
    for (auto& column : contacts.vectors) column.resize(contacts.key.size(), is_new ? Vec3{} : 1e-5 * other);
    if (is_new) return;
    contacts.row.back() = {-load * other, 1e-4, (slides ? 1e-3 : 1e-7) * other, 0};
    contacts.vectors[2].back() = unit_or((jumps ? -1 : 1) * normal + (jumps ? 0.3 : 0.01) * other, {});
  }
  ContactScene scene(Contacts& columns, Real time_step) {
    ContactScene scene{};
    scene.contacts = columns.view();
    scene.bodies = bodies.view();
    scene.pairs = pairs.data();
    scene.material_count = kMaterials;
    scene.step = {time_step, false};
    return scene;
  }
  template <class Patch>
  Patch patch_of(int c) const {
    if constexpr (std::is_same_v<Patch, NoPatch>)
      return {};
    else
      return patch[static_cast<std::size_t>(c)];
  }

  template <class Friction, class Record>
  Contacts one_by_one(const Friction& friction, Real time_step) {
    Contacts columns = contacts;
    const ContactScene scene = this->scene(columns, time_step);
    for (int c = 0; c < static_cast<int>(elastic.size()); ++c) {
      const int a = dem_gpu::key_body_a(columns.key[c]), b = dem_gpu::key_body_b(columns.key[c]);
      ElasticContact contact = elastic[static_cast<std::size_t>(c)];
      dem_gpu::respond<PointDamping, Friction, Record>(
          scene.contacts, c, contact, body_side(scene.bodies, a), body_side(scene.bodies, b),
          scene.pair(bodies.material[a], bodies.material[b]), friction, patch_of<typename Friction::Patch>(c),
          scene.step, std::min(bodies.diameter[a], bodies.diameter[b]));
    }
    return columns;
  }
  template <class Friction, class Record>
  Contacts side_by_side(const Friction& friction, Real time_step) {
    Contacts columns = contacts;
    const ContactScene scene = this->scene(columns, time_step);
    dem_gpu::ContactLanes<typename Friction::Patch> touching;
    const int count = static_cast<int>(elastic.size());
    for (int c = 0; c < count; ++c) {
      touching.append(c, dem_gpu::key_body_a(columns.key[c]), dem_gpu::key_body_b(columns.key[c]),
                      elastic[static_cast<std::size_t>(c)], patch_of<typename Friction::Patch>(c));
      if (touching.is_full() || c + 1 == count)
        dem_gpu::respond_to_all<PointDamping, Friction, Record>(scene, friction, touching);
    }
    return columns;
  }
};

Real largest(const std::vector<Vec3>& column) {
  Real of_all = 0;
  for (const Vec3& v : column) of_all = std::max(of_all, norm(v));
  return of_all;
}
Real largest(const std::vector<Real>& column) {
  Real of_all = 0;
  for (const Real v : column) of_all = std::max(of_all, std::abs(v));
  return of_all;
}

constexpr Real kRounding = 1e-12;  // of a column's largest entry

void expect_same(const Contacts& lanes, const Contacts& single) {
  for (std::size_t i = 0; i < single.numbers.size(); ++i)
    for (std::size_t c = 0; c < single.key.size(); ++c)
      EXPECT_NEAR(lanes.numbers[i][c], single.numbers[i][c], kRounding * largest(single.numbers[i])) << i << ' ' << c;
  const auto of_lanes = lanes.all_vectors(), of_single = single.all_vectors();
  for (std::size_t i = 0; i < of_single.size(); ++i)
    for (std::size_t c = 0; c < single.key.size(); ++c)
      EXPECT_LE(norm(of_lanes[i][c] - of_single[i][c]), kRounding * largest(of_single[i])) << i << ' ' << c;
  for (std::size_t c = 0; c < single.key.size(); ++c) EXPECT_EQ(lanes.row[c].depth, single.row[c].depth) << c;
}

// A last block that is not full, and none that is.
constexpr int kCounts[] = {1, 4 * kRealLanes + 3, 12 * kRealLanes};

TEST(ContactLanes, AnswerAsOneContactDoes) {
  for (const int count : kCounts)
    for (const Real time_step : {0., 1e-5}) {
      RandomContacts some(count);
      const PatchFriction friction{0.8};
      expect_same(some.side_by_side<PatchFriction, NoWorkRecord>(friction, time_step),
                  some.one_by_one<PatchFriction, NoWorkRecord>(friction, time_step));
      expect_same(some.side_by_side<NoFriction, NoWorkRecord>({}, time_step),
                  some.one_by_one<NoFriction, NoWorkRecord>({}, time_step));
    }
}

TEST(ContactLanes, RecordTheSameWorkOnce) {
  for (const int count : kCounts) {
    RandomContacts some(count);
    const PatchFriction friction{0.8};
    const Contacts recorded = some.side_by_side<PatchFriction, WorkRecord>(friction, 1e-5);
    expect_same(recorded, some.one_by_one<PatchFriction, WorkRecord>(friction, 1e-5));
    const Contacts plain = some.side_by_side<PatchFriction, NoWorkRecord>(friction, 1e-5);
    for (std::size_t c = 0; c < plain.row.size(); ++c) {
      EXPECT_EQ(recorded.row[c].force, plain.row[c].force) << "motion does not depend on the record";
      EXPECT_EQ(recorded.torques[c].torque_b, plain.torques[c].torque_b);
    }
  }
}

}  // namespace
