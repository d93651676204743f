// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/fit/part_fit.h"
#include "decomposition/search/cut_tree.h"

namespace decomposition {

/// Everything needed to try cuts of one piece.
struct CutTrial {
  const Solid& solid;
  const SearchPlan& plan;
  const Piece& piece;
  const std::vector<Vec3>& points;  // spread over the piece
  std::vector<Stretch> columns{};   // of the piece, where stand-ins are to enclose it
};

/// A short fit, or a hull by support points (see column_hull).
struct TrialPlan {
  int directions, rounds;
  int vertices, steps, samples_along, stride;
  double first_step, last_step;  // share of the diagonal
};

/// A cut with convex stand-ins of its two sides, fitted alike for all cuts that are compared.
struct CutScore {
  Plane plane;
  double misfit = 0;      // sum of both sides, see ColumnOverlap::misfit; infinite for a cut that is not allowed
  bool is_exact = false;  // both sides are convex as they stand: no better cut exists
};

/// Random directions times quantiles of the points along them. Of a drawn solid then its own facet planes at re-entrant
/// edges. Of a scan, unless hulls are compared, the planes through the piece's centroid across its principal
/// directions, among which are its planes of symmetry, if it has any, and planes into its valleys, where its surface
/// lies deepest below the stand-in, and from one valley to another.
std::vector<Plane> candidate_planes(const CutTrial& trial, Random& random);

/// The cut moved and turned a little: `reach` is the largest move / size of the piece, which has that middle.
Plane nudged_plane(const Vec3& middle, double size, const Plane& plane, double reach, Random& random);

CutScore score_cut(const CutTrial& trial, const Plane& plane, const TrialPlan& fit, std::uint64_t seed);

}  // namespace decomposition
