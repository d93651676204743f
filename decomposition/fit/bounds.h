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

/// Points of the solid's surface that decide whether a bound is kept: the parts hold the solid when each holds the
/// points of its own cell, and each section those on its cut.
struct BoundPoints {
  std::vector<std::vector<Vec3>> in_cell;     // (n_leaves) off the cuts
  std::vector<std::vector<Vec3>> on_section;  // (n_sections)
};

/// `hulls_only`: of each cell the corners of their convex hull only.
BoundPoints bound_points(const Solid& solid, const Partition& partition, bool hulls_only);

/// Adds the middles of the pieces of the solid's surface that lie deeper than `tolerance` [m] in a part: where edges of
/// a part run through the surface between its vertices. Returns how many.
int add_points_inside(const Solid& solid, const Partition& partition, double tolerance, BoundPoints& points);

/// Moves own points and corners so that outer faces and edges of sections that break the bound come nearer to keeping
/// it. `slack` [m] is kept beyond it; every move is `eagerness` times what one face alone would need. Returns the
/// largest breach found before, negative if there is none; infinite if a part collapsed.
double push_towards_bound(const Solid& solid, Partition& partition, Bound bound, const BoundPoints& points,
                          double slack, double eagerness = 1);

}  // namespace decomposition
