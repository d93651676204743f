// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/periodic/periodic_lattice.h"

namespace dem_gpu {

/// Ghosts: copies of the bodies near a face of a periodic box, set one box length further, so that bodies at the other
/// face meet them as any body. They stand behind the bodies in the columns that contacts read, are listed anew with the
/// neighbour list and follow their owners every step; what acts on a ghost acts on its owner. All columns are empty
/// without a periodic box.
struct GhostColumns {
  DeviceVector<std::int64_t> id;  // (owner << 5) | code of the lattice step to it, ascending (n_ghosts)
  DeviceVector<Vec3> wraps;       // whole box lengths each body has been taken back by since time 0 (n_bodies) [-]
  BodyConstants constants;        // of the bodies, ghosts behind them
};

TALUS_HD inline std::int64_t ghost_id(int owner, const LatticeStep& step) {
  return (static_cast<std::int64_t>(owner) << 5) | static_cast<std::int64_t>(code_of(step));
}

/// What stands behind an index of a body: itself, or the owner and where its ghost stands.
struct GhostView {
  const std::int64_t* id;
  int count;
  int body_count;

  TALUS_HD bool is_ghost(int i) const { return i >= body_count; }
  TALUS_HD int owner(int i) const { return is_ghost(i) ? static_cast<int>(id[i - body_count] >> 5) : i; }
  TALUS_HD LatticeStep step(int i) const {
    return is_ghost(i) ? lattice_step(static_cast<int>(id[i - body_count] & 31)) : LatticeStep{};
  }
};

}  // namespace dem_gpu
