// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/pass.h"

namespace dem_gpu {

/// The boxes of a scene; one endless box for a scene that is not periodic.
PeriodicLattice lattice_of(const Scene& scene);

/// Bodies with ghosts behind them: what contacts see.
inline BodyView bodies_with_ghosts(const Model& model, State& state) {
  return view(model.scene.periodic ? state.ghosts.constants : model.bodies, state.bodies);
}

inline GhostView ghost_view(const Model& model, const State& state) {
  return {pointer(state.ghosts.id), static_cast<int>(state.ghosts.id.size()),
          static_cast<int>(model.bodies.shape.size())};
}

/// Ghosts' ids on the host, for what reads contacts there.
class GhostOwners {
 public:
  GhostOwners(const Model& model, const State& state)
      : id_(to_host(state.ghosts.id)), body_count_(static_cast<int>(model.bodies.shape.size())) {}
  int owner(int body) const { return view().owner(body); }
  LatticeStep step(int body) const { return view().step(body); }

 private:
  GhostView view() const { return {id_.data(), static_cast<int>(id_.size()), body_count_}; }

  std::vector<std::int64_t> id_;
  int body_count_;
};

/// Columns of a run that starts, without ghosts yet.
void start_ghosts(const Model& model, State& state);

/// What a new list of ghosts changed, for the contacts to follow.
struct GhostChange {
  DeviceVector<std::int64_t> former_id;  // GhostColumns::id before
  DeviceVector<int> step;                // lattice step code that each body was taken back by (n_bodies)
};

/// Takes bodies that have left the box back in at the other side, and lists the ghosts anew.
GhostChange renew_ghosts(const Model& model, State& state);

/// The key that each contact of `key` had before the change; one that no contact has where there was none.
DeviceVector<ContactKey> former_keys(const Model& model, const State& state, const DeviceVector<ContactKey>& key,
                                     const GhostChange& change);

/// Takes the contact points along with their bodies.
void wrap_contact_points(const Model& model, const GhostChange& change, ContactColumns& contacts);

/// Sizes the columns for the ghosts that `state.ghosts.id` names, and sets what stays the same for each.
void fit_columns_to_ghosts(const Model& model, State& state);

/// Ghosts follow their owners.
std::unique_ptr<Pass> make_update_ghosts_pass();

}  // namespace dem_gpu
