// SPDX-License-Identifier: Apache-2.0
#include "workflows/population/population_comparison.h"

#include <algorithm>
#include <cmath>

namespace workflows {
namespace {

constexpr double kMeanShare = 0.02, kSpreadShare = 0.1, kCorrelation = 0.1;
constexpr double kStandardErrors = 3;
constexpr double kOneInAHundred = 1.628;  // of the distance times sqrt(n), for large n (Smirnov 1948)

double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

/// About the first value, so that equal values have it as their mean to the last bit, and no spread.
double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

double central_moment(const std::vector<double>& values, double mean, int power) {
  double sum = 0;
  for (const double value : values) sum += std::pow(value - mean, power);
  return sum / static_cast<double>(values.size());
}

FormSummary summary_of(const std::vector<double>& sorted) {
  const auto count = static_cast<double>(sorted.size());
  FormSummary summary;
  summary.mean = mean_of(sorted);
  summary.spread = std::sqrt(central_moment(sorted, summary.mean, 2) * count / (count - 1));
  summary.percentile_5 = percentile(sorted, 0.05);
  summary.median = percentile(sorted, 0.5);
  summary.percentile_95 = percentile(sorted, 0.95);
  return summary;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == value) ++i;
    while (j < b.size() && b[j] == value) ++j;
    largest = std::max(largest, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                         static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return largest;
}

std::vector<double> figures_of(const std::vector<FormRow>& rows, std::size_t figure) {
  std::vector<double> values;
  for (const FormRow& row : rows) values.push_back(row[figure]);
  return values;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    aa += (a[k] - mean_a) * (a[k] - mean_a);
    ab += (a[k] - mean_a) * (b[k] - mean_b);
    bb += (b[k] - mean_b) * (b[k] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

FigureComparison compared(const std::vector<double>& reference, const std::vector<double>& made, double per_count) {
  FigureComparison result;
  result.reference = summary_of(reference);
  result.made = summary_of(made);
  const double spread = result.reference.spread;
  const double fourth = central_moment(reference, result.reference.mean, 4);
  result.mean_error = spread * std::sqrt(per_count);
  if (spread > 0)
    result.spread_error = std::sqrt(std::max(0.0, fourth - std::pow(spread, 4)) * per_count) / (2 * spread);
  result.mean_limit = std::max(kMeanShare * std::abs(result.reference.mean), kStandardErrors * result.mean_error);
  result.spread_limit = std::max(kSpreadShare * spread, kStandardErrors * result.spread_error);
  result.distance = largest_difference(reference, made);
  result.distance_limit = kOneInAHundred * std::sqrt(per_count);
  return result;
}

}  // namespace

bool FigureComparison::mean_agrees() const { return std::abs(made.mean - reference.mean) <= mean_limit; }
bool FigureComparison::spread_agrees() const { return std::abs(made.spread - reference.spread) <= spread_limit; }
bool CorrelationComparison::agrees() const { return std::abs(made - reference) <= limit; }

bool PopulationComparison::agrees() const {
  return std::all_of(figures.begin(), figures.end(), [](const FigureComparison& figure) { return figure.agrees(); }) &&
         std::all_of(correlations.begin(), correlations.end(),
                     [](const CorrelationComparison& pair) { return pair.agrees(); });
}

std::vector<double> sorted_figure(const std::vector<FormRow>& rows, std::size_t figure) {
  std::vector<double> values = figures_of(rows, figure);
  std::sort(values.begin(), values.end());
  return values;
}

PopulationComparison compare_populations(const std::vector<FormRow>& reference, const std::vector<FormRow>& made,
                                         Samples samples) {
  PopulationComparison result{reference.size(), made.size(), {}, {}};
  double per_count = 1 / static_cast<double>(made.size());
  if (samples == Samples::independent) per_count += 1 / static_cast<double>(reference.size());
  for (std::size_t c = 0; c < kFormFigures; ++c)
    result.figures[c] = compared(sorted_figure(reference, c), sorted_figure(made, c), per_count);
  for (std::size_t a = 0; a < kFormFigures; ++a)
    for (std::size_t b = a + 1; b < kFormFigures; ++b) {
      const double known = correlation(figures_of(reference, a), figures_of(reference, b));
      const double error = (1 - known * known) * std::sqrt(per_count);
      result.correlations.push_back({a, b, known, correlation(figures_of(made, a), figures_of(made, b)),
                                     std::max(kCorrelation, kStandardErrors * error)});
    }
  for (const FormRow& row : reference) ++result.reference_classes[zingg_class(row[kSOverI], row[kIOverL])];
  for (const FormRow& row : made) ++result.made_classes[zingg_class(row[kSOverI], row[kIOverL])];
  return result;
}

}  // namespace workflows
