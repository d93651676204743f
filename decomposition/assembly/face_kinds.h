// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/assembly/part_builder.h"

namespace decomposition {

/// How well the faces on the cuts match.
struct CutCoverage {
  double covered_area = 0;  // of one side of the cuts, covered by the other [m2]
  double ledge_area = 0;    // wrongly marked: uncovered area of inner faces and covered area of outer ones [m2]
};

/// How far faces on cuts may be split.
struct SplitLimits {
  int vertices;                   // of a part, at most
  int faces = 1000;               // of a part, at most
  double smallest_ledge = 0.005;  // share of a face's area: smaller ledges are left
};

/// Marks the faces on cuts that their neighbours across the cut cover as inner. A face that stands out beyond its
/// neighbours is split along their outline as far as the limits allow; else the larger share of its area decides, and
/// the rest is counted as ledge.
CutCoverage mark_faces(std::vector<BuiltPart>& parts, const std::vector<Plane>& cuts, const SplitLimits& limits);

}  // namespace decomposition
