// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "decomposition/fit/partition.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// What a finished part must keep to. Short edges and narrow faces cost a contact search its precision and a simulation
/// its time step.
struct PartRules {
  int vertices = 64;             // at most
  int faces = 0;                 // at most, the triangles on a cut as one; 0: no cap
  double shortest_edge = 0.01;   // / size of the part, the largest distance of two of its vertices
  double narrowest_face = 0.02;  // / size of the part: width of a face, of a triangle its least height
  double largest_loss = 0.002;   // of a part's volume for one flaw, while other means are left
};

/// What to leave out for the rules' sake.
enum class Trim {
  caps,        // own points and corners of sections, until the caps hold
  own_points,  // own points alone, where these can help, against short edges and narrow faces, too
  flaws,       // own points and corners of sections against all breaches, where these can help at little loss
  all          // also corners that a part has from others, by itself: leaves a small ledge
};

/// Leaves out points of the parts, each time the one that costs the least volume, until the rules hold. At most
/// `most` points a leaf for flaws. Returns how many own points each leaf has lost; empty if a part collapsed.
std::vector<int> trim(const Solid& solid, Partition& partition, const PartRules& rules, Trim what, int most = 1000);

/// Number of breaches of the rules.
int count_flaws(const Solid& solid, const Partition& partition, const PartRules& rules);

/// Leaves out own points that fell inside.
void drop_dead_points(const Solid& solid, Partition& partition);

/// Moves the own points along the surface's normal until the union has the volume.
void correct_volume(const Solid& solid, Partition& partition, double volume);

/// Scales the whole partition, cuts included, to `ratio` of its volume: no rule and no seam is touched.
void scale_volume(Partition& partition, const Vec3& centre, double ratio);

}  // namespace decomposition
