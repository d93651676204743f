// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bench_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace workflows {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

constexpr int kColumns = 6;
using Row = std::array<std::string, kColumns>;

const Row kHeader{"case", "figure", "value", "unit", "goal", "met"};

Row row_of(const ReportedFigure& reported) {
  const Figure& figure = reported.figure;
  const std::optional<bool> met = is_goal_met(figure);
  return {
      reported.case_name, figure.name,       figure.value ? number_text(*figure.value) : "failed: " + figure.failure,
      figure.unit,        goal_text(figure), !met ? "" : *met ? "yes" : "no"};
}

}  // namespace

std::string goal_text(const Figure& figure) {
  if (!figure.goal) return "";
  return (figure.goal->sense == Goal::Sense::at_most ? "<= " : ">= ") + number_text(figure.goal->bound);
}

std::optional<bool> is_goal_met(const Figure& figure) {
  if (!figure.goal) return std::nullopt;
  if (!figure.value) return false;
  const Goal& goal = *figure.goal;
  return goal.sense == Goal::Sense::at_most ? *figure.value <= goal.bound : *figure.value >= goal.bound;
}

std::string json_lines(const std::vector<ReportedFigure>& figures) {
  using Json = nlohmann::ordered_json;
  std::string lines;
  for (const ReportedFigure& reported : figures) {
    const Figure& figure = reported.figure;
    const std::optional<bool> met = is_goal_met(figure);
    Json line;
    line["bench"] = reported.bench;
    line["case"] = reported.case_name;
    line["figure"] = figure.name;
    line["value"] = figure.value ? Json(*figure.value) : Json(nullptr);
    line["unit"] = figure.unit;
    line["goal"] = figure.goal ? Json(goal_text(figure)) : Json(nullptr);
    line["met"] = met ? Json(*met) : Json(nullptr);
    line["command"] = reported.command;
    lines += line.dump() + "\n";
  }
  return lines;
}

std::string text_table(const std::vector<ReportedFigure>& figures) {
  std::vector<Row> rows{kHeader};
  for (const ReportedFigure& reported : figures) rows.push_back(row_of(reported));
  std::array<std::size_t, kColumns> width{};
  for (const Row& row : rows)
    for (int c = 0; c < kColumns; ++c) width[c] = std::max(width[c], row[c].size());
  std::string table;
  for (const Row& row : rows) {
    std::string line;
    for (int c = 0; c < kColumns; ++c) line += row[c] + std::string(width[c] - row[c].size() + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  }
  return table;
}

std::string markdown_table(const std::string& title, const std::vector<ReportedFigure>& figures) {
  const auto line = [](const Row& row, const std::string& command) {
    std::string text = "|";
    for (const std::string& cell : row) text += " " + cell + " |";
    return text + " " + command + " |\n";
  };
  std::string table = "# " + title + "\n\n" + line(kHeader, "command") + "|---|---|---:|---|---|---|---|\n";
  for (const ReportedFigure& reported : figures) table += line(row_of(reported), "`" + reported.command + "`");
  return table;
}

}  // namespace workflows
