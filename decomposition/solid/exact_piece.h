// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "decomposition/solid/solid.h"

namespace decomposition {

/// A piece of the solid that is convex as it stands.
struct ExactPiece {
  std::vector<Vec3> points;  // corners of its hull
  double volume = 0;         // [m3]
  double thickness = 0;      // smallest extent along a face normal [m]
};

struct ExactCaps {
  int vertices;
  int faces;  // 0: any number
};

/// The part of the solid in `cell` if it is convex and its hull keeps to the caps; decided by comparing
/// exact volumes, to rounding. Only for solids with few facets (see Solid::facet_planes and Solid::is_faceted).
std::optional<ExactPiece> exact_piece(const Solid& solid, const std::vector<Plane>& cell, const ExactCaps& caps);

/// Corners of the hull of the part of the solid in `cell`, the tightest convex part that holds it; none if it breaks
/// the caps, and none for solids with many facets.
std::vector<Vec3> capped_hull(const Solid& solid, const std::vector<Plane>& cell, const ExactCaps& caps);

}  // namespace decomposition
