// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "workflows/population/form_table.h"
#include "workflows/population/zingg_class.h"

namespace workflows {

/// Of one figure over a population; lengths in metres.
struct FormSummary {
  double mean = 0, spread = 0;                             // spread: standard deviation
  double percentile_5 = 0, median = 0, percentile_95 = 0;  // between ranks linearly
};

struct FigureComparison {
  FormSummary reference, made;
  double mean_error = 0, spread_error = 0;  // standard errors that the counts allow
  double mean_limit = 0, spread_limit = 0;  // largest differences that agree
  double distance = 0, distance_limit = 0;  // Kolmogorov & Smirnov: largest difference of the two distributions

  bool mean_agrees() const;
  bool spread_agrees() const;
  bool distribution_agrees() const { return distance <= distance_limit; }
  bool agrees() const { return mean_agrees() && spread_agrees() && distribution_agrees(); }
};

struct CorrelationComparison {
  std::size_t first = 0, second = 0;  // FormFigure
  double reference = 0, made = 0, limit = 0;

  bool agrees() const;
};

struct PopulationComparison {
  std::size_t reference_count = 0, made_count = 0;
  std::array<FigureComparison, kFormFigures> figures;
  std::vector<CorrelationComparison> correlations;  // of each pair
  std::array<std::size_t, kZinggClasses.size()> reference_classes{}, made_classes{};

  bool agrees() const;
};

/// Whether the rows of the one are drawn from the other, which then counts as known without error.
enum class Samples { independent, drawn_from_reference };

/// Both hold at least two rows. Agreement: means within 2 % or three standard errors, standard deviations within 10 %
/// or three (of them, from the reference's fourth moment), correlations within 0.1 or three (1 - r^2) / sqrt(n),
/// distance within 1.63 / sqrt(n), which chance exceeds once in a hundred (Smirnov 1948); 1 / n is the sum of that of
/// both for independent samples. A figure that does not vary has correlation 0.
PopulationComparison compare_populations(const std::vector<FormRow>& reference, const std::vector<FormRow>& made,
                                         Samples samples);

/// Values of one figure, ascending.
std::vector<double> sorted_figure(const std::vector<FormRow>& rows, std::size_t figure);

}  // namespace workflows
