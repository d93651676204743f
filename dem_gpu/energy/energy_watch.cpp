// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/energy/energy_watch.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/periodic/ghosts.h"

namespace dem_gpu {
namespace {

/// Energy from nothing, as a share of what was put in, that no law and no step within its bounds makes: a run beyond it
/// is on its way to infinity.
constexpr double kExplosion = 0.5;
/// Below this share of the energy of a fall through the bodies' own diameters there is nothing to measure.
constexpr double kLeastEnergy = 1e-6;

double energy_of_a_small_fall(const Model& model) {
  const auto mass = to_host(model.bodies.mass);
  const auto diameter = to_host(model.bodies.diameter);
  double energy = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) energy += mass[i] * norm(model.scene.gravity) * diameter[i];
  return energy;
}

std::size_t fastest_body(const State& state) {
  const auto velocity = to_host(state.bodies.velocity);
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < velocity.size(); ++i)
    if (norm_squared(velocity[i]) > norm_squared(velocity[fastest])) fastest = i;
  return fastest;
}

/// Side b of a contact.
std::string partner_name(const Model& model, const GhostOwners& ghosts, ContactKey key) {
  const int b = key_body_b(key);
  return is_wall_kind(key_kind(key)) ? "wall '" + model.scene.walls[b].name + "'"
                                     : "body " + std::to_string(ghosts.owner(b));
}

/// "; its deepest contact is with body 7" or wall.
std::string deepest_partner(const Model& model, const State& state, int body) {
  const auto keys = to_host(state.contacts.key);
  const auto rows = to_host(state.contacts.row);
  const GhostOwners ghosts(model, state);
  std::string partner;
  Real deepest = 0;
  for (std::size_t c = 0; c < keys.size(); ++c) {
    const int a = key_body_a(keys[c]);
    const bool is_wall = is_wall_kind(key_kind(keys[c]));
    const int b = is_wall ? -1 : ghosts.owner(key_body_b(keys[c]));
    if ((a != body && b != body) || rows[c].depth <= deepest) continue;
    deepest = rows[c].depth;
    partner = is_wall || a == body ? partner_name(model, ghosts, keys[c]) : "body " + std::to_string(a);
  }
  return partner.empty() ? "" : "; its deepest contact is with " + partner;
}

}  // namespace

std::string step_place(const Model& model, const State& state) {
  char place[80];
  std::snprintf(place, sizeof place, "step %lld, time %.6g s: ", static_cast<long long>(state.step),
                double(state.time(model)));
  return place;
}

void watch_energy(const Model& model, State& state) {
  if (!model.features.has_ledger) return;
  const EnergyLedger ledger = make_ledger(model, state);
  state.accounts.largest_throughput = ledger.throughput;
  const double limit = kExplosion * std::max(0.0, ledger.throughput) + kLeastEnergy * energy_of_a_small_fall(model);
  if (!(-ledger.imbalance() > limit && ledger.kinetic > limit)) return;
  const std::size_t body = fastest_body(state);
  char energies[160];
  std::snprintf(energies, sizeof energies, "%.4g J of kinetic energy came from nothing (%.4g J were put in)",
                -ledger.imbalance(), ledger.throughput);
  throw std::runtime_error(step_place(model, state) + energies + "; body " + std::to_string(body) + " is the fastest" +
                           deepest_partner(model, state, static_cast<int>(body)) +
                           ". Use a shorter time step or more steps per contact, and check that no bodies overlap at "
                           "the start");
}

void refuse_pushed_through(const Model& model, const State& state) {
  // In diameters of the smaller body. A field pushes out the nearest way: from here on that is the far side.
  constexpr Real kThrough = 1;
  // A scene that lets bodies start deeper means them to.
  const Real limit = std::max(kThrough, model.scene.run.largest_start_overlap);
  if (max_of(state.contacts.peak_overlap, Real(0)) < limit) return;
  const auto overlap = to_host(state.contacts.peak_overlap);
  const auto c = static_cast<std::size_t>(std::max_element(overlap.begin(), overlap.end()) - overlap.begin());
  const ContactKey key = state.contacts.key[c];
  char depth[48];
  std::snprintf(depth, sizeof depth, "%.3g diameters of the smaller", double(overlap[c]));
  throw std::runtime_error(step_place(model, state) + "body " + std::to_string(key_body_a(key)) + " and " +
                           partner_name(model, GhostOwners(model, state), key) + " have sunk into one another by " +
                           depth +
                           ", and been pushed through; use stiffer contacts (a smaller largest_overlap or a higher "
                           "at_speed), or see what presses them together");
}

}  // namespace dem_gpu
