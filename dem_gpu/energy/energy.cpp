// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/energy/energy.h"

#include <algorithm>
#include <cmath>

#include "dem_gpu/core/parallel.h"
#include "dem_gpu/periodic/ghosts.h"

namespace dem_gpu {
namespace {

double kinetic_energy(double mass, const Vec3& velocity, const Vec3& inertia, const Vec3& angular_velocity) {
  return 0.5 * (mass * norm_squared(velocity) + dot(inertia, hadamard(angular_velocity, angular_velocity)));
}

template <class T>
double sum(const std::vector<T>& values) {
  double total = 0;
  for (const T& value : values) total += value;
  return total;
}

/// Stored energy of the contacts that the marked bodies take part in goes with them.
double stored_in_contacts(const Model& model, const State& state, const std::vector<int>& is_leaving) {
  const auto keys = to_host(state.contacts.key);
  const auto elastic = to_host(state.contacts.elastic_work);
  const auto tangential = to_host(state.contacts.tangential_energy);
  const GhostOwners ghosts(model, state);
  double stored = 0;
  for (std::size_t c = 0; c < elastic.size(); ++c) {
    const bool leaves = is_leaving[key_body_a(keys[c])] ||
                        (!is_wall_kind(key_kind(keys[c])) && is_leaving[ghosts.owner(key_body_b(keys[c]))]);
    if (leaves) stored += elastic[c] + tangential[c];
  }
  return stored;
}

}  // namespace

BodyEnergy body_energy(const Model& model, const State& state) {
  const auto active = to_host(state.bodies.active);
  const auto mass = to_host(model.bodies.mass);
  const auto inertia = to_host(model.bodies.inertia);
  const auto position = to_host(state.bodies.position);
  const auto velocity = to_host(state.bodies.velocity);
  const auto angular_velocity = to_host(state.bodies.angular_velocity);
  const auto wraps = to_host(state.ghosts.wraps);
  const Vec3 length = lattice_of(model.scene).length;
  BodyEnergy energy;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (!active[i]) continue;
    energy.kinetic += kinetic_energy(mass[i], velocity[i], inertia[i], angular_velocity[i]);
    // Along the way it went: what comes back in at the top of a periodic box has not been lifted.
    const Vec3 travelled = wraps.empty() ? position[i] : position[i] + hadamard(wraps[i], length);
    energy.gravitational -= mass[i] * dot(model.scene.gravity, travelled);
  }
  return energy;
}

void remove_bodies(const Model& model, State& state, const std::vector<int>& is_leaving) {
  const BodyEnergy before = body_energy(model, state);
  auto active = to_host(state.bodies.active);
  for (std::size_t i = 0; i < is_leaving.size(); ++i)
    if (is_leaving[i]) active[i] = 0;
  assign(state.bodies.active, active);
  const BodyEnergy after = body_energy(model, state);
  state.accounts.removed_gravitational += before.gravitational - after.gravitational;
  state.accounts.removed_energy += before.kinetic - after.kinetic + before.gravitational - after.gravitational +
                                   stored_in_contacts(model, state, is_leaving);
  state.list_is_stale = true;
}

void close_accounts_of_absent_walls(const Model& model, State& state) {
  if (!model.features.has_ledger) return;
  const auto keys = to_host(state.contacts.key);
  const auto elastic = to_host(state.contacts.elastic_work);
  const auto tangential = to_host(state.contacts.tangential_energy);
  for (std::size_t c = 0; c < keys.size(); ++c) {
    if (!is_wall_kind(key_kind(keys[c]))) continue;
    const int wall = key_body_b(keys[c]);
    if (!state.walls.records()[wall].is_present) state.accounts.wall_work[wall] -= elastic[c] + tangential[c];
  }
}

EnergyLedger make_ledger(const Model& model, const State& state) {
  EnergyLedger ledger;
  if (!model.features.has_ledger) return ledger;
  const Accounts accounts = accounts_so_far(model, state);
  const BodyEnergy energy = body_energy(model, state);
  ledger.kinetic = energy.kinetic;
  ledger.gravitational = energy.gravitational - accounts.initial_gravitational;
  ledger.elastic_normal = sum(to_host(state.contacts.elastic_work));
  ledger.elastic_tangential = sum(to_host(state.contacts.tangential_energy));
  ledger.wall_work = sum(accounts.wall_work);
  ledger.removed = accounts.removed_energy;
  ledger.initial = accounts.initial_kinetic + accounts.initial_elastic;
  for (std::size_t k = 0; k < model.classes.size(); ++k)
    ledger.dissipation.push_back({model.classes[k], accounts.loss_normal[k], accounts.loss_shear[k]});
  // What bodies lost by leaving is not what gravity gave them: wherever the origin lies, it counts down to where they
  // left.
  const double released = -ledger.gravitational - accounts.removed_gravitational;
  // Bodies that bounce back, and walls that take their work back, leave little of it in the end.
  ledger.throughput =
      std::max(accounts.largest_throughput, ledger.initial + std::max(0.0, released) + std::max(0.0, ledger.wall_work));
  return ledger;
}

double EnergyLedger::dissipated() const {
  double total = 0;
  for (const ClassLoss& loss : dissipation) total += loss.normal + loss.shear;
  return total;
}

double EnergyLedger::imbalance() const {
  return initial + wall_work - (kinetic + gravitational + elastic_normal + elastic_tangential + removed + dissipated());
}

Accounts accounts_so_far(const Model& model, const State& state) {
  const ContactColumns& contacts = state.contacts;
  const auto keys = to_host(contacts.key);
  const auto class_of = [&](std::size_t c) {
    return is_wall_kind(key_kind(keys[c])) ? model.wall_class[key_body_b(keys[c])] : 0;
  };
  Accounts accounts = state.accounts;
  const auto overlap = to_host(contacts.peak_overlap);
  const auto rate = to_host(contacts.peak_rate);
  for (std::size_t c = 0; c < overlap.size(); ++c) {
    accounts.largest_overlap = std::max(accounts.largest_overlap, static_cast<double>(overlap[c]));
    accounts.largest_rate = std::max(accounts.largest_rate, static_cast<double>(rate[c]));
  }
  if (model.features.has_ledger) {
    const auto normal = to_host(contacts.loss_normal);
    const auto shear = to_host(contacts.loss_shear);
    const auto work = to_host(contacts.wall_work);
    for (std::size_t c = 0; c < keys.size(); ++c) {
      accounts.loss_normal[class_of(c)] += normal[c];
      accounts.loss_shear[class_of(c)] += shear[c];
      if (is_wall_kind(key_kind(keys[c]))) accounts.wall_work[key_body_b(keys[c])] += work[c];
    }
  }
  if (model.features.has_walls) {
    const auto impulse = to_host(contacts.wall_impulse);
    const auto angular = to_host(contacts.wall_angular_impulse);
    for (std::size_t c = 0; c < keys.size(); ++c) {
      if (!is_wall_kind(key_kind(keys[c]))) continue;
      accounts.wall_impulse[key_body_b(keys[c])] += impulse[c];
      accounts.wall_angular_impulse[key_body_b(keys[c])] += angular[c];
    }
  }
  return accounts;
}

void collect_accounts(const Model& model, State& state) {
  state.accounts = accounts_so_far(model, state);
  ContactColumns& contacts = state.contacts;
  for (DeviceVector<Real>* column :
       {&contacts.peak_overlap, &contacts.peak_rate, &contacts.loss_normal, &contacts.loss_shear, &contacts.wall_work})
    fill(*column, Real(0));
  for (DeviceVector<Vec3>* column : {&contacts.wall_impulse, &contacts.wall_angular_impulse}) fill(*column, Vec3{});
}

}  // namespace dem_gpu
