// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/population/matched_shapes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/target_grain.h"
#include "workflows/in_order.h"
#include "workflows/population/comparison_report.h"
#include "workflows/shape_sampling.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

constexpr double kMostMiss = 0.3;    // of the sphericity, over its standard deviation: that then is a tenth too small
constexpr double kFineMiss = 0.002;  // of a population without spread

struct Made {
  catalog::ShapeRecord shape;
  bool is_reached = false;
  double sphericity_error = 0;
};

Made made_shape(const FormRow& row, std::uint64_t seed) {
  const shape_pipeline::TargetGrain grain = shape_pipeline::target_grain(
      {row[kDiameter], row[kSOverI], row[kIOverL], row[kConvexity], row[kSphericity]}, seed);
  Made made{shape_pipeline::described_shape(grain.mesh, 0), grain.is_reached(), grain.sphericity_error};
  made.shape.checks.push_back(
      {"target_sphericity", true, grain.sphericity_error,
       formatted("sphericity less the row's, convexity %+.4f; the nearest of %d random fields: amplitude %.3f, level "
                 "%.2f, power falls as degree^-%g",
                 grain.convexity_error, grain.fields, grain.amplitude, grain.level, grain.exponent)});
  return made;
}

std::vector<catalog::Check> population_checks(const MatchedShapes& made, const FormTable& reference) {
  std::vector<catalog::Check> checks;
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    const FigureComparison& figure = made.comparison.figures[c];
    checks.push_back({std::string("population_") + kFormNames[c], figure.agrees(),
                      figure.made.mean / figure.reference.mean - 1, "whole population, " + figure_text(figure)});
  }
  double largest = 0;
  bool agrees = true;
  for (const CorrelationComparison& pair : made.comparison.correlations) {
    largest = std::max(largest, std::abs(pair.made - pair.reference));
    agrees = agrees && pair.agrees();
  }
  checks.push_back({"population_correlations", agrees, largest,
                    "whole population, largest difference of a correlation; expected 0.1 or three standard errors"});
  const double spread = made.comparison.figures[kSphericity].reference.spread;
  checks.push_back(
      {"population_targets", made.sphericity_miss <= std::max(kMostMiss * spread, kFineMiss),
       spread > 0 ? made.sphericity_miss / spread : 0,
       formatted("whole population, %zu of %zu shapes have the convexity and sphericity of their rows to 0.001, the "
                 "others are the nearest that a star-shaped field without needles gave; sphericity off by %.4f (root "
                 "mean square), %.3f at most; figure: over the reference's standard deviation, expected at most %g",
                 made.reached, made.shapes.size(), made.sphericity_miss, made.largest_miss, kMostMiss)});
  checks.push_back({"population_assumption", true, static_cast<double>(reference.rows.size()),
                    "rows of the reference taken for whole single grains, as measured; " + reference.axes});
  return checks;
}

}  // namespace

MatchedShapes matched_shapes(const FormTable& reference, const std::vector<std::size_t>& rows,
                             const MatchedShapesOptions& options) {
  RandomSource random(~options.seed);  // other numbers than a draw of rows with this seed has
  std::vector<std::uint64_t> seeds;
  for (std::size_t k = 0; k < rows.size(); ++k) seeds.push_back(random.next());

  MatchedShapes result;
  OrderedWork<Made> work;
  work.count = static_cast<int>(rows.size());
  work.threads = threads_to_use(options.threads);
  work.begin = [](int) {};
  work.make = [&](int k) {
    const auto place = static_cast<std::size_t>(k);
    return made_shape(reference.rows[rows[place]], seeds[place]);
  };
  work.take = [&](int, Made&& made) {
    result.shapes.push_back(std::move(made.shape));
    result.reached += made.is_reached ? 1 : 0;
    result.sphericity_miss += made.sphericity_error * made.sphericity_error;
    result.largest_miss = std::max(result.largest_miss, std::abs(made.sphericity_error));
  };
  run_in_order(work);
  result.sphericity_miss = std::sqrt(result.sphericity_miss / static_cast<double>(rows.size()));

  std::vector<FormRow> forms;
  for (const catalog::ShapeRecord& shape : result.shapes) forms.push_back(form_row("a made grain", shape.descriptors));
  result.comparison = compare_populations(reference.rows, forms, Samples::drawn_from_reference);
  const std::vector<catalog::Check> checks = population_checks(result, reference);
  for (catalog::ShapeRecord& shape : result.shapes)
    shape.checks.insert(shape.checks.end(), checks.begin(), checks.end());
  return result;
}

}  // namespace workflows
