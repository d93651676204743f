// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "postprocess/svg_plot.h"
#include "workflows/population/comparison_report.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

constexpr int kPanelWidth = 460, kPanelHeight = 300, kPanelsAcross = 2;  // [px]

constexpr std::array<const char*, kFormFigures> kAxes{"equivalent_diameter_volume [mm]", "s_over_i_inertia [-]",
                                                      "i_over_l_inertia [-]", "convexity_volume_ratio [-]",
                                                      "sphericity_wadell [-]"};

/// Share of the grains up to each value: a step at each.
postprocess::Curve cumulative(const NamedRows& population, std::size_t figure, bool is_dashed) {
  const std::vector<double> values = sorted_figure(population.rows, figure);
  postprocess::Curve curve{formatted("%s (%zu)", population.name.c_str(), values.size()), {}, {}, is_dashed};
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const std::size_t below : {k, k + 1}) {
      curve.x.push_back(figure == kDiameter ? 1e3 * values[k] : values[k]);
      curve.y.push_back(static_cast<double>(below) / static_cast<double>(values.size()));
    }
  return curve;
}

}  // namespace

std::string distributions_svg(const NamedRows& reference, const NamedRows& made) {
  constexpr int kRows = (static_cast<int>(kFormFigures) + kPanelsAcross - 1) / kPanelsAcross;
  std::string page = formatted("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\">\n",
                               kPanelsAcross * kPanelWidth, kRows * kPanelHeight);
  const PopulationComparison comparison = compare_populations(reference.rows, made.rows, Samples::independent);
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    postprocess::LinePlot plot;
    plot.title = formatted("Kolmogorov-Smirnov distance %.3f", comparison.figures[c].distance);
    plot.x_label = kAxes[c];
    plot.y_label = "share of grains [-]";
    plot.curves = {cumulative(reference, c, false), cumulative(made, c, true)};
    plot.y_range = {0, 1};
    plot.width = kPanelWidth;
    plot.height = kPanelHeight;
    const int place = static_cast<int>(c);
    page += formatted("<g transform=\"translate(%d %d)\">\n", place % kPanelsAcross * kPanelWidth,
                      place / kPanelsAcross * kPanelHeight) +
            postprocess::svg(plot) + "</g>\n";
  }
  return page + "</svg>\n";
}

}  // namespace workflows
