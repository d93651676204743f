// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/population/population_comparison.h"

namespace workflows {

/// A table for people: moments and percentiles of both, distances, correlations, shares of the classes of form.
std::string comparison_text(const PopulationComparison& comparison, const std::string& reference,
                            const std::string& made);

/// A JSON object in text, SI units.
std::string comparison_json(const PopulationComparison& comparison, const std::string& reference,
                            const std::string& made);

/// "mean 0.8688 (reference 0.869, agrees to 0.017), ..." of one figure, in one line.
std::string figure_text(const FigureComparison& figure);

/// A population with its name in plots.
struct NamedRows {
  std::string name;
  const std::vector<FormRow>& rows;
};

/// One SVG file: cumulative distributions of both, a panel a figure.
std::string distributions_svg(const NamedRows& reference, const NamedRows& made);

}  // namespace workflows
