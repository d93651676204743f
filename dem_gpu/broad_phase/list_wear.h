// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/gate.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

/// When the neighbour list is worn: two bodies may each have come half a skin closer; the walls' own motion takes its
/// share. Seen to by the kernel that moves the bodies, so that nobody has to look for the largest displacement.
struct ListWear {
  Real skin;         // [m]
  Real walls_moved;  // farthest that a wall's surface can have moved since the list was made [m]
  int* is_worn;      // raised on the device
  int* halted_at;    // of the block that the step is part of, null for none; halted where the list is renewed
  int list_place;

  /// A body has come this far since the list was made; infinite if it is lost.
  template <class Number>
  TALUS_HD void note(const Number& displacement) const {
    if (bits_of(2 * displacement + walls_moved > Number{} + skin) == 0) return;
    raise(is_worn, 1);
    if (halted_at) raise(halted_at, list_place);
  }
};

}  // namespace dem_gpu
