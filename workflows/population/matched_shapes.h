// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "catalog/shape_record.h"
#include "workflows/population/population_comparison.h"

namespace workflows {

struct MatchedShapesOptions {
  std::uint64_t seed = 1;
  int threads = 0;  // 0: as many as the machine has
};

/// New solids with the forms of rows; names and provenance are left to the caller.
struct MatchedShapes {
  std::vector<catalog::ShapeRecord> shapes;  // one a row, checked and described
  std::size_t reached = 0;                   // shapes whose convexity and sphericity are as in the row, to 0.001
  double sphericity_miss = 0;                // root mean square of made less asked for
  double largest_miss = 0;                   // the same, largest magnitude
  PopulationComparison comparison;           // of the reference with what was made
};

/// Each solid takes size, axes, convexity and sphericity of one of the reference's rows (at least two) as far as a
/// random star-shaped field reaches them (shape_pipeline/target_grain.h); its check "target_sphericity" has how far it
/// is off. Every shape carries the checks of the whole population: "population_" with the name of each figure
/// (difference of the means over the reference's), "population_correlations" (largest difference), "population_targets"
/// (sphericity_miss over the reference's standard deviation, expected 0.3 at most) and "population_assumption". The
/// same table, rows and options give the same bytes for any number of threads.
MatchedShapes matched_shapes(const FormTable& reference, const std::vector<std::size_t>& rows,
                             const MatchedShapesOptions& options);

}  // namespace workflows
