// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/report_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>

namespace workflows {

FigureTable::FigureTable(const std::vector<ReportedFigure>& figures) {
  for (const ReportedFigure& reported : figures)
    if (reported.figure.value) values_[{reported.case_name, reported.figure.name}] = *reported.figure.value;
}

double FigureTable::operator()(const std::string& case_name, const std::string& figure) const {
  const auto found = values_.find({case_name, figure});
  return found == values_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

std::string aligned_markdown(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t kLeftColumns = 2;
  std::vector<std::size_t> width(rows.front().size(), 3);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string table;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(width[c] - row[c].size(), ' ');
      table += "| " + (c < kLeftColumns ? row[c] + padding : padding + row[c]) + " ";
    }
    table += "|\n";
    if (&row != &rows.front()) continue;
    for (std::size_t c = 0; c < row.size(); ++c)
      table += c < kLeftColumns ? "|" + std::string(width[c] + 2, '-') : "|" + std::string(width[c] + 1, '-') + ":";
    table += "|\n";
  }
  return table;
}

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "an unnamed processor";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

}  // namespace workflows
