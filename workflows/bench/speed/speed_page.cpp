// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <optional>

#include "workflows/bench/bench_report.h"
#include "workflows/bench/speed/speed_cases.h"

namespace workflows {
namespace {

/// Of one case, by the figure's name.
const ReportedFigure* figure_of(const std::vector<ReportedFigure>& figures, const std::string& case_name,
                                const std::string& name) {
  for (const ReportedFigure& reported : figures)
    if (reported.case_name == case_name && reported.figure.name == name) return &reported;
  return nullptr;
}

std::string number(const ReportedFigure* reported, const char* format) {
  if (!reported || !reported->figure.value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, *reported->figure.value);
  return text;
}

std::string row(const std::vector<ReportedFigure>& figures, const std::string& case_name) {
  const auto cell = [&](const char* name, const char* format) {
    return number(figure_of(figures, case_name, name), format);
  };
  const ReportedFigure* time = figure_of(figures, case_name, kStepTime);
  std::string text = "| " + case_name + " | " + cell(kStepTime, "%.3f") + " (" + cell(kStepTimeLeast, "%.3f") + " to " +
                     cell(kStepTimeLargest, "%.3f") + ") | " + goal_text(time->figure) + " | " +
                     cell(kParticleSteps, "%.3g") + " | " + cell(kRatio, "%.2f") + " | " + cell(kSpeedUp, "%.2f") +
                     " | " + cell(kCoordination, "%.2f") + " | " + cell(kEnergyError, "%.1e") + " | " +
                     cell(kAllocated, "%.1f") + " |\n";
  return text;
}

}  // namespace

std::string speed_page(const std::vector<ReportedFigure>& figures) {
  std::string page = "# Speed\n\n";
  std::string last;
  for (const ReportedFigure& reported : figures) {
    if (reported.figure.name != kStepTime || reported.case_name == last) continue;
    if (last.empty())
      page +=
          "Median of three windows, least to largest; over LIGGGHTS: on S1 box in the same go.\n\n"
          "| case | ms a step | goal | particle-steps/s | over LIGGGHTS | 2 threads | contacts | energy error | MB |\n"
          "|---|---|---|---:|---:|---:|---:|---:|---:|\n";
    last = reported.case_name;
    page += row(figures, last);
  }
  return page + "\n" + markdown_table("All figures", figures).replace(0, 1, "##");
}

}  // namespace workflows
