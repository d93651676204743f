// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/fit/partition.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// What the parts of a partition may leave out or take in.
enum class Bound {
  none,
  holds_solid,  // every point of the solid lies in a part
  stays_inside  // no part sticks out of the solid
};

/// Points of the solid's surface in every leaf's cell, those on the cuts included: the parts hold the solid when each
/// holds the points of its own cell. `hulls_only`: of each cell the corners of their convex hull only.
std::vector<std::vector<Vec3>> surface_points(const Solid& solid, const Partition& partition, bool hulls_only);

/// Moves own points and corners so that outer faces that break the bound come nearer to keeping it. The points are
/// those of surface_points; `slack` [m] is kept beyond them. Returns the largest breach found before, negative if there
/// is none; infinite if a part collapsed.
double push_towards_bound(const Solid& solid, Partition& partition, Bound bound,
                          const std::vector<std::vector<Vec3>>& points, double slack);

}  // namespace decomposition
