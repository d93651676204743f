// SPDX-License-Identifier: Apache-2.0
#include "workflows/population/comparison_report.h"

#include <nlohmann/json.hpp>

#include "workflows/text_format.h"

namespace workflows {
namespace {

using Json = nlohmann::ordered_json;

const char* verdict(bool agrees) { return agrees ? "agrees" : "DIFFERS"; }

/// Lengths are shown in millimetres.
double shown_factor(std::size_t figure) { return figure == kDiameter ? 1e3 : 1; }

std::string shown_name(std::size_t figure) {
  return std::string(kFormNames[figure]) + (figure == kDiameter ? " [mm]" : " [-]");
}

std::string summary_line(const char* whose, const FormSummary& summary, double factor) {
  return formatted("  %-10s %9.4g %9.4g %9.4g %9.4g %9.4g", whose, factor * summary.mean, factor * summary.spread,
                   factor * summary.percentile_5, factor * summary.median, factor * summary.percentile_95);
}

Json summary_json(const FormSummary& summary) {
  return {{"mean", summary.mean},
          {"standard_deviation", summary.spread},
          {"percentile_5", summary.percentile_5},
          {"median", summary.median},
          {"percentile_95", summary.percentile_95}};
}

Json figure_json(const FigureComparison& figure) {
  return {{"reference", summary_json(figure.reference)},
          {"made", summary_json(figure.made)},
          {"standard_error_of_mean", figure.mean_error},
          {"standard_error_of_standard_deviation", figure.spread_error},
          {"mean_limit", figure.mean_limit},
          {"standard_deviation_limit", figure.spread_limit},
          {"kolmogorov_smirnov_distance", figure.distance},
          {"kolmogorov_smirnov_limit", figure.distance_limit},
          {"agrees", figure.agrees()}};
}

Json classes_json(const std::array<std::size_t, kZinggClasses.size()>& classes) {
  Json counts;
  for (std::size_t k = 0; k < classes.size(); ++k) counts[kZinggClasses[k]] = classes[k];
  return counts;
}

}  // namespace

std::string figure_text(const FigureComparison& figure) {
  return formatted(
      "mean %.4g (reference %.4g, limit of the difference %.2g), standard deviation %.4g (%.4g, %.2g), "
      "Kolmogorov-Smirnov distance %.3f (limit %.3f)",
      figure.made.mean, figure.reference.mean, figure.mean_limit, figure.made.spread, figure.reference.spread,
      figure.spread_limit, figure.distance, figure.distance_limit);
}

std::string comparison_text(const PopulationComparison& comparison, const std::string& reference,
                            const std::string& made) {
  std::string text = formatted("reference %s, %zu grains; made %s, %zu grains\n", reference.c_str(),
                               comparison.reference_count, made.c_str(), comparison.made_count);
  text += formatted("  %-10s %9s %9s %9s %9s %9s\n", "", "mean", "sd", "5 %", "median", "95 %");
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    const FigureComparison& figure = comparison.figures[c];
    const double factor = shown_factor(c);
    text += shown_name(c) + "\n" + summary_line("reference", figure.reference, factor) + "\n" +
            summary_line("made", figure.made, factor) + "\n";
    text += formatted("  %-10s %9.2g %9.2g  mean %s, sd %s, Kolmogorov-Smirnov distance %.3f (limit %.3f) %s\n",
                      "std. error", factor * figure.mean_error, factor * figure.spread_error,
                      verdict(figure.mean_agrees()), verdict(figure.spread_agrees()), figure.distance,
                      figure.distance_limit, verdict(figure.distribution_agrees()));
  }
  text += formatted("%-54s %9s %9s %9s\n", "correlation", "reference", "made", "limit");
  for (const CorrelationComparison& pair : comparison.correlations)
    text += formatted("  %-52s %9.3f %9.3f %9.3f %s\n",
                      (std::string(kFormNames[pair.first]) + ", " + kFormNames[pair.second]).c_str(), pair.reference,
                      pair.made, pair.limit, verdict(pair.agrees()));
  text += "Zingg's classes [share]\n";
  for (std::size_t k = 0; k < kZinggClasses.size(); ++k)
    text += formatted(
        "  %-10s reference %.3f, made %.3f\n", kZinggClasses[k],
        static_cast<double>(comparison.reference_classes[k]) / static_cast<double>(comparison.reference_count),
        static_cast<double>(comparison.made_classes[k]) / static_cast<double>(comparison.made_count));
  return text;
}

std::string comparison_json(const PopulationComparison& comparison, const std::string& reference,
                            const std::string& made) {
  Json result{{"reference", reference},
              {"reference_count", comparison.reference_count},
              {"made", made},
              {"made_count", comparison.made_count},
              {"agrees", comparison.agrees()}};
  for (std::size_t c = 0; c < kFormFigures; ++c) result["figures"][kFormNames[c]] = figure_json(comparison.figures[c]);
  for (const CorrelationComparison& pair : comparison.correlations)
    result["correlations"].push_back({{"figures", {kFormNames[pair.first], kFormNames[pair.second]}},
                                      {"reference", pair.reference},
                                      {"made", pair.made},
                                      {"limit", pair.limit},
                                      {"agrees", pair.agrees()}});
  result["zingg_classes"] = {{"reference", classes_json(comparison.reference_classes)},
                             {"made", classes_json(comparison.made_classes)}};
  return result.dump();
}

}  // namespace workflows
