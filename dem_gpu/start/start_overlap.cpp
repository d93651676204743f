// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/start/start_overlap.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <utility>

#include "catalog/input_error.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/overlap_probe.h"
#include "dem_gpu/periodic/ghosts.h"
#include "dem_gpu/start/lone_pair.h"

namespace dem_gpu {
namespace {

/// Shallower overlaps are rounding of faces that touch, and hold no energy to speak of: its share of a contact's goes
/// with the square of this. In least widths.
constexpr Real kLeastDepth = local_tolerance(1e-9, 1e-6);

StartPair pair_of(ContactKey key, const GhostOwners& ghosts, const PeriodicLattice& lattice) {
  const ContactKind kind = key_kind(key);
  const int a = key_body_a(key), b = key_body_b(key);
  if (is_wall_kind(kind)) return {kind, a, b};
  return {kind, a, ghosts.owner(b), lattice.shift(ghosts.step(b))};
}

std::string name_of_partner(const Scene& scene, const StartPair& pair) {
  return pair.has_wall() ? "wall '" + scene.walls[pair.b].name + "'" : "body " + std::to_string(pair.b);
}

[[noreturn]] void refuse(const Scene& scene, const StartPair& pair, const std::string& overlap) {
  throw catalog::InputError("body " + std::to_string(pair.a) + " and " + name_of_partner(scene, pair) +
                            " overlap at the start by " + overlap +
                            "; move them apart, or raise the largest start overlap (run.largest_start_overlap) if they "
                            "are meant to spring apart");
}

/// Bodies with about one and the same middle push each other nowhere, and their surfaces may lie in one another: no
/// depth shows them.
void refuse_concentric(const Model& model, const StartPair& pair) {
  const Scene& scene = model.scene;
  const Body &a = scene.bodies[pair.a], &b = scene.bodies[pair.b];
  const Shape &shape_a = scene.shapes[a.shape], &shape_b = scene.shapes[b.shape];
  const OverlapProbe probe(shape_a, shape_b, scene.polyhedral_law);
  const Real volume = probe
                          .overlap({{a.position, normalized(a.orientation), a.scale},
                                    {b.position + pair.shift_b, normalized(b.orientation), b.scale}})
                          .volume;
  const Real smaller =
      std::min(shape_a.volume * a.scale * a.scale * a.scale, shape_b.volume * b.scale * b.scale * b.scale);
  if (volume <= scene.run.largest_start_overlap * smaller) return;
  char text[96];
  std::snprintf(text, sizeof text, "%.3g %% of the smaller body's volume, one about the other's middle",
                double(100 * volume / smaller));
  refuse(scene, pair, text);
}

/// Work of the contact on a as a is drawn away along the force at the start [J]: the energy stored, for a law that is a
/// gradient.
Real stored_energy(LonePair pair, const Vec3& force, Real depth) {
  const Vec3 away = unit_or(force, {0, 0, 1});
  Real touching = 0, apart = depth;
  while (norm(pair.force_at(apart * away)) > 0) touching = std::exchange(apart, 2 * apart);
  constexpr int kHalvings = 6;
  for (int i = 0; i < kHalvings; ++i) {
    const Real middle = (touching + apart) / 2;
    (norm(pair.force_at(middle * away)) > 0 ? touching : apart) = middle;
  }
  // Gauss-Legendre, 4 points a panel. A way out that is long against the depth crosses more than one contact.
  constexpr std::array<Real, 4> kPoint{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                       0.8611363115940526};
  constexpr std::array<Real, 4> kWeight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  constexpr Real kFewestPanels = 8, kMostPanels = 64;
  const int panels = static_cast<int>(std::clamp(4 * apart / depth, kFewestPanels, kMostPanels));
  Real work = 0;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < kPoint.size(); ++i) {
      const Real place = apart * (panel + (1 + kPoint[i]) / 2) / panels;
      work += kWeight[i] * apart / (2 * panels) * dot(pair.force_at(place * away), away);
    }
  return work;
}

}  // namespace

void refuse_deep_start(const Model& model, const State& state) {
  const Scene& scene = model.scene;
  const auto keys = to_host(state.contacts.key);
  const auto rows = to_host(state.contacts.row);
  const auto width = to_host(model.bodies.least_width);
  const GhostOwners ghosts(model, state);
  const PeriodicLattice lattice = lattice_of(scene);
  for (std::size_t c = 0; c < keys.size(); ++c) {
    const StartPair pair = pair_of(keys[c], ghosts, lattice);
    const Real thinner = pair.has_wall() ? width[pair.a] : std::min(width[pair.a], width[pair.b]);
    if (rows[c].depth > scene.run.largest_start_overlap * thinner) {
      char text[96];
      std::snprintf(text, sizeof text, "%.4g m, %.3g %% of the thinner body's least width (at most %.3g %%)",
                    double(rows[c].depth), double(100 * rows[c].depth / thinner),
                    double(100 * scene.run.largest_start_overlap));
      refuse(scene, pair, text);
    }
    if (pair.kind == ContactKind::polyhedron_polyhedron &&
        norm(scene.bodies[pair.a].position - scene.bodies[pair.b].position - pair.shift_b) < thinner / 2)
      refuse_concentric(model, pair);
  }
}

void refuse_fast_walls(const Model& model, const State& state) {
  // A swing in fewer steps than a contact takes in the draft preset, both ways, is no swing.
  constexpr Real kLeastStepsPerSwing = 20;
  for (const Wall& wall : model.scene.walls) {
    const Real steps = 1 / (std::abs(wall.motion.frequency) * model.time_step);
    if (wall.motion.frequency == 0 || steps >= kLeastStepsPerSwing) continue;
    char text[160];
    std::snprintf(
        text, sizeof text,
        "swings at %.4g Hz, %.3g steps of %.4g s a period; at least %g are needed: use a lower frequency or a "
        "time step of at most %.3g s",
        double(wall.motion.frequency), double(steps), double(model.time_step), double(kLeastStepsPerSwing),
        double(steps / kLeastStepsPerSwing * model.time_step));
    throw catalog::InputError("wall '" + wall.name + "': " + text);
  }
  const Real travel = state.walls.largest_displacement(model.time_step);
  const auto width = to_host(model.bodies.least_width);
  const auto thinnest = std::min_element(width.begin(), width.end());
  if (travel <= kTravelShare * *thinnest) return;
  const auto body = thinnest - width.begin();
  const std::string wall = "wall '" + model.scene.walls[state.walls.fastest(model.time_step)].name + "': ";
  if (!std::isfinite(travel))
    throw catalog::InputError(wall + "its motion is too fast to reckon with; use a slower one");
  char text[320];
  std::snprintf(text, sizeof text,
                "moves up to %.4g m in a step of %.4g s, more than a quarter of the least width of body %td (%.4g m), "
                "so that it could pass through it; use a time step of at most %.3g s, or a slower motion",
                double(travel), double(model.time_step), body, double(*thinnest),
                double(kTravelShare * *thinnest / travel * model.time_step));
  throw catalog::InputError(wall + text);
}

Real book_start_energy(const Model& model, State& state) {
  const auto keys = to_host(state.contacts.key);
  const auto rows = to_host(state.contacts.row);
  const auto width = to_host(model.bodies.least_width);
  auto stored = to_host(state.contacts.elastic_work);
  const GhostOwners ghosts(model, state);
  const PeriodicLattice lattice = lattice_of(model.scene);
  const HostShapeColumns shapes = to_host(model.shapes.columns);
  Real sum = 0;
  for (std::size_t c = 0; c < keys.size(); ++c) {
    if (!(rows[c].depth > kLeastDepth * width[key_body_a(keys[c])])) continue;
    stored[c] = stored_energy(LonePair(model, shapes, pair_of(keys[c], ghosts, lattice)), rows[c].force, rows[c].depth);
    sum += stored[c];
  }
  assign(state.contacts.elastic_work, stored);
  return sum;
}

}  // namespace dem_gpu
