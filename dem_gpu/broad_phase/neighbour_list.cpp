// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/neighbour_list.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "dem_gpu/broad_phase/candidate_pairs.h"
#include "dem_gpu/broad_phase/skin.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy_watch.h"
#include "dem_gpu/meshes/facet_lists.h"
#include "dem_gpu/periodic/ghosts.h"

namespace dem_gpu {
namespace {

/// Length of each contact's separating-plane cache.
struct CountPartPairs {
  ContactView contacts;
  BodyView bodies;
  const ShapeRange* shapes;
  const WallRecord* walls;

  TALUS_HD void operator()(int c) const {
    const ContactKey key = contacts.key[c];
    const ContactKind kind = key_kind(key);
    int pairs = 0;
    if (kind == ContactKind::polyhedron_polyhedron)
      pairs = shapes[bodies.shape[key_body_a(key)]].part_count * shapes[bodies.shape[key_body_b(key)]].part_count;
    else if (kind == ContactKind::polyhedron_object)
      pairs = shapes[bodies.shape[key_body_a(key)]].part_count;
    contacts.cache_begin[c] = pairs;
  }
};

/// Copies what contact c carried before the list was rebuilt, if it was there.
struct CarryHistory {
  ContactView from, to;
  const ContactKey* former_key;  // of each contact of `to`, in `from`
  int from_count;
  ContactFeatures features;

  /// Both tables ascend, but for keys that a periodic box has changed: the search goes on from the last place.
  TALUS_HD void operator()(int begin, int end) const {
    int old = lower_bound(from.key, from_count, former_key[begin]);
    for (int c = begin; c < end; ++c) {
      const ContactKey key = former_key[c];
      if (c > begin && key < former_key[c - 1]) old = lower_bound(from.key, from_count, key);
      while (old < from_count && from.key[old] < key) ++old;
      if (old < from_count && from.key[old] == key) carry(c, old);
    }
  }

  TALUS_HD void carry(int c, int old) const {
    visit_history(features, [&](auto column) { (to.*column)[c] = (from.*column)[old]; });
    to.is_truncated[c] = from.is_truncated[old];
    if (features.has_waiting_pairs) to.apart_until[c] = from.apart_until[old];
    if (!features.has_polyhedra) return;
    const int length = to.cache_begin[c + 1] - to.cache_begin[c];
    for (int k = 0; k < length; ++k) to.separating[to.cache_begin[c] + k] = from.separating[from.cache_begin[old] + k];
  }
};

/// The body of a side of a contact, 2 * contact + side; a ghost's is its owner, a wall's one behind all bodies.
struct BodyOfSide {
  const ContactKey* key;
  GhostView ghosts;

  TALUS_HD int operator()(int side) const {
    const ContactKey contact = key[side / 2];
    if (side % 2 == 0) return key_body_a(contact);
    return is_wall_kind(key_kind(contact)) ? ghosts.body_count : ghosts.owner(key_body_b(contact));
  }
};

struct MarkListed {
  BodyView bodies;
  TALUS_HD void operator()(int i) const {
    bodies.listed_position[i] = bodies.position[i];
    bodies.listed_displacement[i] = 0;
  }
};

/// `change`: of the ghosts, null without a periodic box.
void carry_history(const Model& model, State& state, const GhostChange* change, ContactColumns& next) {
  const int count = static_cast<int>(next.key.size()), old_count = static_cast<int>(state.contacts.key.size());
  if (old_count == 0) return;
  DeviceVector<ContactKey> former;
  if (change) former = former_keys(model, state, next.key, *change);
  parallel_for_ranges(
      0, count,
      CarryHistory{view(state.contacts), view(next), pointer(change ? former : next.key), old_count, model.features});
  if (change) wrap_contact_points(model, *change, next);
}

void list_incidence(const Model& model, State& state) {
  const GhostView ghosts = ghost_view(model, state);
  const int side_count = 2 * static_cast<int>(state.contacts.key.size());
  sort_into_rows(side_count, ghosts.body_count + 1, BodyOfSide{pointer(state.contacts.key), ghosts},
                 state.incident_first, state.incident);
  state.incident_first.resize(static_cast<std::size_t>(ghosts.body_count) + 1);  // of bodies alone
}

[[noreturn]] void report_lost_body(const Model& model, const State& state) {
  const auto displacement = to_host(state.bodies.listed_displacement);
  std::size_t body = 0;
  while (body + 1 < displacement.size() && std::isfinite(displacement[body])) ++body;
  const Vec3 x = state.bodies.position[body], v = state.bodies.velocity[body];
  const auto text = [](const Vec3& a) {
    char components[64];
    std::snprintf(components, sizeof components, "(%.6g, %.6g, %.6g)", double(a.x), double(a.y), double(a.z));
    return std::string(components);
  };
  const Vec3 spin = state.bodies.angular_velocity[body];
  const Real width = model.bodies.least_width[body], radius = model.bodies.bounding_radius[body];
  const Real speed = norm(v) + (width < 2 * radius ? radius * norm(spin) : Real(0));
  char tail[320];
  if (std::isfinite(speed) && norm(x) < Real(1e300))
    std::snprintf(
        tail, sizeof tail,
        " m/s and turns at %.6g rad/s: up to %.4g m in a step, more than a quarter of its least width of %.4g "
        "m, so that it could pass through another body; use a time step of at most %.3g s, or check what sped "
        "it up",
        double(norm(spin)), double(speed * model.time_step), double(width), double(kTravelShare * width / speed));
  else
    std::snprintf(tail, sizeof tail,
                  " m/s, no longer a finite motion; use a shorter time step or softer contacts, and check that no "
                  "bodies overlap at the start");
  throw std::runtime_error(step_place(model, state) + "body " + std::to_string(body) + " at " + text(x) +
                           " m moves at " + text(v) + tail);
}

/// Not in a periodic box, whose ghosts reach as far as the skin.
void fit_skin(const Model& model, State& state) {
  // A list of spheres costs as much as testing its candidates in 12 steps, measured; polyhedra that are apart wait.
  constexpr Real kSpheresList = 12, kPolyhedraList = 60;
  if (model.scene.periodic || !(model.time_step > 0)) return;
  const auto steps = std::llround((state.time(model) - state.listed_time) / model.time_step);
  state.skin = next_skin(state.skin, steps, model.mean_diameter,
                         model.features.has_waiting_pairs ? kPolyhedraList : kSpheresList);
}

class NeighbourList : public Pass {
 public:
  std::string name() const override { return "neighbour_list"; }
  void run(const Model& model, State& state) override {
    const bool is_worn = state.list_is_worn[0] != 0;  // by the pass that moves the bodies
    if (!is_worn && !state.list_is_stale) return;
    if (!std::isfinite(max_of(state.bodies.listed_displacement, Real(0)))) report_lost_body(model, state);
    watch_energy(model, state);
    refuse_pushed_through(model, state);
    if (is_worn) fit_skin(model, state);
    build_neighbour_list(model, state);
  }
  /// Nothing: that pass halts the block here.
  void launch(const Model& /*model*/, State& /*state*/, const Gate& /*gate*/) override {}
  bool renews_list() const override { return true; }
};

}  // namespace

void build_neighbour_list(const Model& model, State& state) {
  collect_accounts(model, state);
  const bool is_periodic = model.scene.periodic.has_value();
  GhostChange change;
  if (is_periodic) change = renew_ghosts(model, state);
  const BodyView bodies = bodies_with_ghosts(model, state);
  ContactColumns next;
  next.key = candidate_keys(model, state);
  const int count = static_cast<int>(next.key.size());
  resize_columns(next, count, model.features);
  if (model.features.has_polyhedra) {
    parallel_for(0, count,
                 CountPartPairs{view(next), bodies, pointer(model.shapes.columns.shapes), state.walls.device()});
    next.separating.assign(static_cast<std::size_t>(exclusive_scan(next.cache_begin)), SeparatingPlane{0});
  }
  if (model.features.has_meshes) list_facets(model, state, next);
  carry_history(model, state, is_periodic ? &change : nullptr, next);
  state.contacts = std::move(next);
  std::array<ContactKey, kContactKinds + 1> bounds;
  for (int kind = 0; kind <= kContactKinds; ++kind)
    bounds[static_cast<std::size_t>(kind)] = contact_key(static_cast<ContactKind>(kind), 0, 0);
  const std::vector<int> below = counts_below(state.contacts.key, bounds);
  for (std::size_t kind = 0; kind < kContactKinds; ++kind) state.range[kind] = {below[kind], below[kind + 1]};
  list_incidence(model, state);
  parallel_for(0, static_cast<int>(model.bodies.shape.size()), MarkListed{bodies});
  state.listed_time = state.time(model);
  state.list_is_stale = false;
  fill(state.list_is_worn, 0);
  ++state.columns_version;
  ++state.accounts.list_rebuilds;
}

std::unique_ptr<Pass> make_neighbour_list_pass() { return std::make_unique<NeighbourList>(); }

}  // namespace dem_gpu
