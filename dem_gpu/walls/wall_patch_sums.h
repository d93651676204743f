// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "dem_gpu/narrow_phase/patch_sums.h"

namespace dem_gpu {

/// What friction needs of the surface inside a wall, world frame about the body's centre. The wall is the flat side:
/// its normals are the patch's, each with the load that the body's surface presses along it.
struct WallPatchSums {
  Mat3 tensor{{}, {}, {}};  // sum of load n n^T, loads that pull left out
  Real pressed = 0;         // sum of the same loads
  Real load = 0;            // sum of all loads: integral of depth dA along the wall's normal
  Real second_moment = 0;   // integral of depth |x|^2 dA

  /// A piece of the body's surface with its depth integral and its outward normal, the wall's normal there and the
  /// piece's share of second_moment.
  TALUS_HD void add(Real depth, const Vec3& normal, const Vec3& along, Real second) {
    const Real piece = -depth * dot(normal, along);
    load += piece;
    second_moment += second;
    if (!(piece > 0)) return;
    pressed += piece;
    add_outer_product(tensor, piece, along);
  }
  TALUS_HD Mat3 normals() const { return weighted_sum(pressed > 0 ? 1 / pressed : 0, tensor, 0, tensor); }
};

template <class Patch>
using WallPatchSumsFor = std::conditional_t<std::is_same_v<Patch, NoPatch>, NoPatchSums, WallPatchSums>;

}  // namespace dem_gpu
