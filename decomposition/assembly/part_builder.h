// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "catalog/convex_part.h"
#include "decomposition/fit/part_rules.h"
#include "decomposition/search/cut_tree.h"

namespace decomposition {

/// A finished part and which of its faces lie on which cut.
struct BuiltPart {
  catalog::ConvexPart part;
  std::vector<int> face_cut;  // (n_faces) number of the cut a face lies on, -1: none
  Cell cell;
};

/// The hull of the points as a part: points within `snap_distance` [m] of a cut plane are put on it, never across it;
/// coplanar triangles become one polygon; slivers are removed. Nothing if what remains is flat.
std::optional<BuiltPart> build_part(const std::vector<Vec3>& points, const Cell& cell, double snap_distance);

/// The same, with vertices left out, each time the one that costs the least volume, until the part keeps to the rules.
std::optional<BuiltPart> build_part_by_rules(const std::vector<Vec3>& points, const Cell& cell, double snap_distance,
                                             const PartRules& rules);

/// Moves p by units in the last place until it lies on the inner side of every plane that it is within `distance` of,
/// the sign of normal . p - offset taken in quadruple precision. `inside` lies behind all planes.
Vec3 nudged_inside(const Vec3& p, const std::vector<Plane>& planes, double distance, const Vec3& inside);

/// normal . p - offset in quadruple precision: the products are exact.
int exact_side(const Plane& plane, const Vec3& p);

}  // namespace decomposition
