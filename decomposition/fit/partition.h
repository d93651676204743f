// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// One side of a cut: the half-space behind its plane, or behind the reversed plane.
struct CutSide {
  int cut;
  bool is_reversed;
};

struct Cut {
  Plane plane;                 // seen from the half that is not reversed
  std::vector<CutSide> sides;  // of the cell that it divides: earlier cuts
};

/// A convex polygon on a cut that parts of both its sides share: the hull of its own corners and of the points where
/// the polygons of earlier cuts end on this one. Where the solid's section falls apart there are several.
struct Section {
  int cut;
  std::vector<int> walls;     // earlier sections that end on this one: those of earlier cuts with a leaf in common
  std::vector<Vec3> corners;  // own, on the plane, strictly inside the cell that the cut divides
};

/// A convex part to be: the hull of its own points, strictly inside its cell, and of its cell's share of its sections.
struct Leaf {
  std::vector<CutSide> sides;  // of the cell
  std::vector<int> sections;   // on those sides
  std::vector<Vec3> points;    // own, off all cuts
  std::vector<Vec3> dropped;   // places of corners on its cuts that it does without
};

/// Free parameters of a partition without ledges: a part's face on a cut is the share of one section in the part's
/// cell, so that both sides of a cut always have the same outline.
struct Partition {
  std::vector<Cut> cuts;          // in the order made
  std::vector<Section> sections;  // in the order of their cuts
  std::vector<Leaf> leaves;

  const Cut& cut_of(const Section& section) const { return cuts[static_cast<std::size_t>(section.cut)]; }
  Plane plane_of(const CutSide& side) const {
    const Plane& plane = cuts[static_cast<std::size_t>(side.cut)].plane;
    return side.is_reversed ? plane.reversed() : plane;
  }
  std::vector<Plane> planes_of(const std::vector<CutSide>& sides) const {
    std::vector<Plane> planes;
    for (const CutSide& side : sides) planes.push_back(plane_of(side));
    return planes;
  }
};

}  // namespace decomposition
