// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "catalog/triangle_mesh.h"
#include "decomposition/convex_decomposition.h"

namespace workflows {

/// One level made with one seed.
struct LevelRun {
  catalog::LevelOfDetail level;
  decomposition::LevelFigures figures;
  int overlapping_pairs = 0;  // see overlapping_pairs()
  double cpu_seconds = 0;     // of the ladder it was made in, measuring included
};

/// Pairs of parts that no plane of any part's face separates, without tolerance.
int overlapping_pairs(const std::vector<catalog::ConvexPart>& parts);

/// Levels with these numbers of parts, made together.
std::vector<LevelRun> run_ladder(const catalog::TriangleMesh& mesh, const std::vector<int>& part_counts,
                                 const decomposition::DecompositionOptions& options);

/// Over the runs of one level with several seeds; the upper one of the two middle figures where their number is even.
double median(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure);
double least(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure);
double most(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure);

}  // namespace workflows
