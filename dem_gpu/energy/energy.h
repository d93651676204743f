// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

struct BodyEnergy {
  double kinetic = 0;        // translation and rotation [J]
  double gravitational = 0;  // about the world's origin [J]
};

/// Summed over the active bodies in their order.
BodyEnergy body_energy(const Model& model, const State& state);

/// Makes the marked bodies inactive and books their energy as removed; asks for a new neighbour list.
void remove_bodies(const Model& model, State& state, const std::vector<int>& is_leaving);

/// Elastic energy in contacts with walls that have just gone leaves with them, as work they took back.
void close_accounts_of_absent_walls(const Model& model, State& state);

/// Reads only: however often it is asked for, the run goes on the same to the last bit.
EnergyLedger make_ledger(const Model& model, const State& state);

}  // namespace dem_gpu
