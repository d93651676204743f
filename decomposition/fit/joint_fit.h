// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "decomposition/fit/partition.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// Share of the diagonal that the parts' own points keep off the cuts.
inline constexpr double kOwnMargin = 2e-3;

/// How long and how finely to fit all parts at once.
struct JointPlan {
  int steps = 400;
  double first_step = 0.02;  // largest move of a corner per step / diagonal; falls geometrically ...
  double last_step = 0.001;  // ... to this
  double cut_rate = 0.2;     // of the cut planes' steps against the corners'; 0: planes stand still
  int samples_along = 4;     // at most this squared sample points a face
  double smallest_part = 0;  // [m3]: cuts draw back from parts that come near this
  double volume = 0;         // of the union, steered to [m3]; 0: least symmetric difference only
  double rock_weight = 1;    // of rock left out against void taken in
  // Short edges and flat triangles are pushed wider, with this strength against the pull of rock or void.
  double spread = 0;
  double shortest_edge = 0.012, narrowest_face = 0.024;  // / size of the part: below, the push sets in
  std::uint64_t seed = 1;
  bool revives = true;  // put corners that fell inside the hull back on it
};

/// Moves the parts' own points, the shared corners on the cuts and the cuts so that the symmetric difference of the
/// union and the solid becomes least. False if a part collapsed; the partition is then of no use.
bool fit_jointly(const Solid& solid, Partition& partition, const JointPlan& plan);

}  // namespace decomposition
