// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/digitize/digitize_cases.h"
#include "workflows/population/matched_shapes.h"
#include "workflows/population/stratified_rows.h"

namespace workflows {
namespace {

constexpr std::size_t kGrains = 300;
constexpr double kMeanGoal = 2, kStandardErrors = 3;  // [%], or so many standard errors
constexpr double kSpreadGoal = 10;                    // [%]
constexpr double kCorrelationGoal = 0.1;
constexpr double kMissGoal = 0.2;     // of the standard deviation
constexpr double kSecondsGoal = 0.3;  // of CPU time a grain

}  // namespace

CaseResult measure_population(const std::filesystem::path& scans) {
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  const FormTable reference = read_form_table(scans / kPopulationFile, "");
  const CpuClock clock;
  const MatchedShapes made = matched_shapes(reference, representative_rows(reference.rows, kGrains, 1), {1, 1});
  const double seconds = clock.seconds();
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    const FigureComparison& figure = made.comparison.figures[c];
    const std::string name = kFormNames[c];
    const double mean = figure.reference.mean, spread = figure.reference.spread;
    add(name + ", mean off", 100 * std::abs(figure.made.mean / mean - 1), "%",
        at_most(std::max(kMeanGoal, 100 * kStandardErrors * figure.mean_error / mean)));
    add(name + ", standard deviation off", 100 * std::abs(figure.made.spread / spread - 1), "%", at_most(kSpreadGoal));
    add(name + ", Kolmogorov-Smirnov distance", figure.distance, "-", at_most(figure.distance_limit));
  }
  for (const CorrelationComparison& pair : made.comparison.correlations)
    add(std::string("correlation of ") + kFormNames[pair.first] + " and " + kFormNames[pair.second] + ", off",
        std::abs(pair.made - pair.reference), "-", at_most(kCorrelationGoal));
  add("targets reached to 0.001", 100 * static_cast<double>(made.reached) / kGrains, "%", std::nullopt);
  add("sphericity off its target, root mean square", made.sphericity_miss, "-",
      at_most(kMissGoal * made.comparison.figures[kSphericity].reference.spread));
  add("CPU time a grain", seconds / kGrains, "s", at_most(kSecondsGoal));
  return result;
}

}  // namespace workflows
