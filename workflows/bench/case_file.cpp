// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/case_file.h"

#include <nlohmann/json.hpp>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"

namespace workflows {
namespace {

using Json = nlohmann::ordered_json;

Json figure_json(const Figure& figure) {
  Json json{{"name", figure.name}, {"unit", figure.unit}, {"failure", figure.failure}};
  json["value"] = figure.value ? Json(*figure.value) : Json(nullptr);
  if (figure.goal) json[figure.goal->sense == Goal::Sense::at_most ? "at_most" : "at_least"] = figure.goal->bound;
  return json;
}

Figure figure_of(const Json& json) {
  Figure figure{json.at("name"), {}, json.at("unit"), {}, json.at("failure")};
  if (!json.at("value").is_null()) figure.value = json["value"].get<double>();
  if (json.contains("at_most")) figure.goal = at_most(json["at_most"]);
  if (json.contains("at_least")) figure.goal = at_least(json["at_least"]);
  return figure;
}

/// Failed runs are NaN, which JSON writes as null.
std::vector<double> numbers_of(const Json& json) {
  std::vector<double> numbers;
  for (const Json& one : json) numbers.push_back(one.is_null() ? kFailedRun : one.get<double>());
  return numbers;
}

Json curve_json(const PlotCurve& curve) {
  return {{"plot", curve.plot}, {"label", curve.label},        {"x", curve.x},
          {"y", curve.y},       {"points", curve.point_names}, {"is_reference", curve.is_reference}};
}

PlotCurve curve_of(const Json& json) {
  return {json.at("plot"),          json.at("label"),  numbers_of(json.at("x")),
          numbers_of(json.at("y")), json.at("points"), json.at("is_reference")};
}

}  // namespace

void write_case(const std::filesystem::path& file, const std::string& made_with, const CaseResult& result) {
  Json figures = Json::array(), curves = Json::array();
  for (const Figure& figure : result.figures) figures.push_back(figure_json(figure));
  for (const PlotCurve& curve : result.curves) curves.push_back(curve_json(curve));
  write_whole(file, Json{{"made_with", made_with}, {"figures", figures}, {"curves", curves}}.dump(1) + "\n");
}

std::optional<CaseResult> read_case(const std::filesystem::path& file, const std::string& made_with) {
  const std::optional<std::string> text = read_whole(file);
  if (!text) return std::nullopt;
  try {
    const Json json = Json::parse(*text);
    if (json.at("made_with") != made_with) return std::nullopt;
    CaseResult result;
    for (const Json& figure : json.at("figures")) {
      result.figures.push_back(figure_of(figure));
      if (!result.figures.back().value) return std::nullopt;
    }
    for (const Json& curve : json.at("curves")) result.curves.push_back(curve_of(curve));
    return result;
  } catch (const nlohmann::json::exception&) {
    throw catalog::InputError(file.string() + ": holds no case of a bench; delete it to measure the case anew");
  }
}

}  // namespace workflows
