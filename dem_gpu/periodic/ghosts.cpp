// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/periodic/ghosts.h"

#include <cmath>
#include <utility>

#include "dem_gpu/core/parallel.h"

namespace dem_gpu {
namespace {

/// Of no contact: its kind does not exist.
constexpr ContactKey kNoKey = ~ContactKey{0};

struct WrapBody {
  BodyView bodies;
  PeriodicLattice lattice;
  Vec3* wraps;
  int* step_code;

  TALUS_HD void operator()(int i) const {
    const LatticeStep step = bodies.active[i] ? lattice.step_to(bodies.position[i]) : LatticeStep{};
    step_code[i] = code_of(step);
    if (step.is_none()) return;
    bodies.position[i] = lattice.inside(bodies.position[i]);
    wraps[i] += Vec3{Real(step.x), Real(step.y), Real(step.z)};
  }
};

/// Counts (ids == nullptr) or writes the ghosts of body i: where a step brings it so near to the box that it may meet a
/// body in it.
struct ListGhosts {
  BodyView bodies;
  PeriodicLattice lattice;
  Real reach;  // of the largest body, skin included [m]
  int* first;
  std::int64_t* ids;

  TALUS_HD void operator()(int i) const {
    int count = 0;
    if (bodies.active[i])
      for (int code = 0; code < kLatticeSteps; ++code) {
        const LatticeStep step = lattice_step(code);
        if (step.is_none() || !lattice.has(step)) continue;
        if (!lattice.is_near(bodies.position[i] + lattice.shift(step), bodies.bounding_radius[i] + reach)) continue;
        if (ids) ids[first[i] + count] = ghost_id(i, step);
        ++count;
      }
    if (!ids) first[i] = count;
  }
};

struct UpdateGhost {
  BodyView bodies;
  GhostView ghosts;
  PeriodicLattice lattice;

  TALUS_HD void operator()(int i) const {
    const int owner = ghosts.owner(i);
    bodies.active[i] = bodies.active[owner];
    bodies.position[i] = bodies.position[owner] + lattice.shift(ghosts.step(i));
    bodies.orientation[i] = bodies.orientation[owner];
    bodies.predicted_velocity[i] = bodies.predicted_velocity[owner];
    bodies.predicted_angular_velocity[i] = bodies.predicted_angular_velocity[owner];
    bodies.mean_velocity[i] = bodies.mean_velocity[owner];
    bodies.mean_angular_velocity[i] = bodies.mean_angular_velocity[owner];
    bodies.contact_share[i] = bodies.contact_share[owner];
  }
};

void update_ghosts(const Model& model, State& state, const Gate& gate = {}) {
  const BodyView bodies = bodies_with_ghosts(model, state);
  const GhostView ghosts = ghost_view(model, state);
  parallel_for(ghosts.body_count, bodies.count, UpdateGhost{bodies, ghosts, lattice_of(model.scene)}, gate);
}

template <class T>
struct CopyOfOwner {
  T* column;
  GhostView ghosts;

  TALUS_HD void operator()(int i) const { column[i] = column[ghosts.owner(i)]; }
};

template <class T>
void resize_and_copy(DeviceVector<T>& column, const GhostView& ghosts) {
  const int count = ghosts.body_count + ghosts.count;
  column.resize(static_cast<std::size_t>(count));
  parallel_for(ghosts.body_count, count, CopyOfOwner<T>{pointer(column), ghosts});
}

/// The pair's bodies were as many steps apart as they are now, less what b was taken back by and a was not.
struct FindFormerKey {
  const ContactKey* key;
  GhostView now, before;
  const int* step_code;
  ContactKey* former;

  TALUS_HD void operator()(int c) const {
    former[c] = key[c];
    const ContactKind kind = key_kind(key[c]);
    if (is_wall_kind(kind)) return;
    const int a = key_body_a(key[c]), b = key_body_b(key[c]), owner = now.owner(b);
    const LatticeStep step = now.step(b) - lattice_step(step_code[owner]) + lattice_step(step_code[a]);
    if (step.is_none()) {
      former[c] = contact_key(kind, a, owner);
      return;
    }
    former[c] = kNoKey;
    if (!step.is_single()) return;
    const std::int64_t id = ghost_id(owner, step);
    const int ghost = lower_bound(before.id, before.count, id);
    if (ghost < before.count && before.id[ghost] == id) former[c] = contact_key(kind, a, before.body_count + ghost);
  }
};

struct WrapContactPoint {
  ContactView contacts;
  PeriodicLattice lattice;
  const int* step_code;

  TALUS_HD void operator()(int c) const {
    if (contacts.depth[c] > 0) contacts.point[c] -= lattice.shift(lattice_step(step_code[key_body_a(contacts.key[c])]));
  }
};

class UpdateGhosts : public Pass {
 public:
  std::string name() const override { return "update_ghosts"; }
  void launch(const Model& model, State& state, const Gate& gate) override { update_ghosts(model, state, gate); }
};

}  // namespace

PeriodicLattice lattice_of(const Scene& scene) {
  Vec3 low{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, high = -low, length;
  if (scene.periodic) {
    const auto set = [](const std::optional<PeriodicSpan>& span, Real& from, Real& to, Real& extent) {
      if (!span) return;
      from = span->low;
      to = span->high;
      extent = to - from;
    };
    set(scene.periodic->span[0], low.x, high.x, length.x);
    set(scene.periodic->span[1], low.y, high.y, length.y);
    set(scene.periodic->span[2], low.z, high.z, length.z);
  }
  return {low, high, length};
}

void start_ghosts(const Model& model, State& state) {
  state.ghosts.constants = model.bodies;
  state.ghosts.wraps.assign(model.bodies.shape.size(), Vec3{});
}

void fit_columns_to_ghosts(const Model& model, State& state) {
  const GhostView ghosts = ghost_view(model, state);
  BodyConstants& constants = state.ghosts.constants;
  resize_and_copy(constants.shape, ghosts);
  resize_and_copy(constants.material, ghosts);
  resize_and_copy(constants.scale, ghosts);
  resize_and_copy(constants.mass, ghosts);
  resize_and_copy(constants.inverse_mass, ghosts);
  resize_and_copy(constants.inertia, ghosts);
  resize_and_copy(constants.inverse_inertia, ghosts);
  resize_and_copy(constants.bounding_radius, ghosts);
  resize_and_copy(constants.diameter, ghosts);
  resize_and_copy(constants.least_width, ghosts);
  const std::size_t count = constants.shape.size();
  BodyColumns& bodies = state.bodies;
  bodies.active.resize(count);
  bodies.orientation.resize(count);
  bodies.contact_share.resize(count);
  for (DeviceVector<Vec3>* column : {&bodies.position, &bodies.predicted_velocity, &bodies.predicted_angular_velocity,
                                     &bodies.mean_velocity, &bodies.mean_angular_velocity})
    column->resize(count);
}

GhostChange renew_ghosts(const Model& model, State& state) {
  const BodyView bodies = view(model.bodies, state.bodies);
  const PeriodicLattice lattice = lattice_of(model.scene);
  GhostChange change;
  change.step.resize(static_cast<std::size_t>(bodies.count));
  parallel_for(0, bodies.count, WrapBody{bodies, lattice, pointer(state.ghosts.wraps), pointer(change.step)});

  DeviceVector<int> first(static_cast<std::size_t>(bodies.count) + 1, 0);
  const Real reach = max_of(model.bodies.bounding_radius, Real(0)) + state.skin;
  ListGhosts list{bodies, lattice, reach, pointer(first), nullptr};
  parallel_for(0, bodies.count, list);
  DeviceVector<std::int64_t> ids(static_cast<std::size_t>(exclusive_scan(first)));
  list.ids = pointer(ids);
  if (!ids.empty()) parallel_for(0, bodies.count, list);
  change.former_id = std::exchange(state.ghosts.id, std::move(ids));
  fit_columns_to_ghosts(model, state);
  update_ghosts(model, state);
  return change;
}

DeviceVector<ContactKey> former_keys(const Model& model, const State& state, const DeviceVector<ContactKey>& key,
                                     const GhostChange& change) {
  const GhostView now = ghost_view(model, state);
  const GhostView before{pointer(change.former_id), static_cast<int>(change.former_id.size()), now.body_count};
  DeviceVector<ContactKey> former(key.size());
  parallel_for(0, static_cast<int>(key.size()),
               FindFormerKey{pointer(key), now, before, pointer(change.step), pointer(former)});
  return former;
}

void wrap_contact_points(const Model& model, const GhostChange& change, ContactColumns& contacts) {
  parallel_for(0, static_cast<int>(contacts.key.size()),
               WrapContactPoint{view(contacts), lattice_of(model.scene), pointer(change.step)});
}

std::unique_ptr<Pass> make_update_ghosts_pass() { return std::make_unique<UpdateGhosts>(); }

}  // namespace dem_gpu
