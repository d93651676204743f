// SPDX-License-Identifier: Apache-2.0
#include "workflows/catalog_listing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "catalog/grade.h"
#include "workflows/error_json.h"
#include "workflows/level_choice.h"
#include "workflows/population/zingg_class.h"

namespace workflows {
namespace {

using catalog::ShapeSummary;
using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

constexpr int kJsonFormat = 1;  // raised when a key changes its meaning
constexpr std::size_t kDescriptorColumns = 4;

std::string figure(double value) {
  if (std::isnan(value)) return "-";  // not measured
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Letters as a terminal counts them: continuation bytes of UTF-8 take no place.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char letter) { return (letter & 0xc0) != 0x80; }));
}

/// Columns as wide as their widest entry, two spaces apart; the first line is the header.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += row[c] + std::string(widths[c] - width_of(row[c]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? std::string() : std::string(" ")) + word;
  return text.empty() ? "-" : text;
}

std::vector<std::string> level_names(const ShapeSummary& shape) {
  std::vector<std::string> names;
  for (const Level& level : shape.levels) {
    const bool is_usual = level.key.mode == catalog::FitMode::volume_true;
    const std::string name = std::to_string(level.key.parts_asked) + (is_usual ? "" : "-" + mode_name(level.key.mode));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// The descriptors that most readers ask for first, then any others, as far as there is room.
std::vector<std::string> columns_for(const std::vector<ShapeSummary>& shapes) {
  std::set<std::string> known;
  for (const ShapeSummary& shape : shapes)
    for (const auto& [name, value] : shape.descriptors) known.insert(name);
  std::vector<std::string> chosen;
  const auto choose = [&](const std::string& name) {
    if (chosen.size() < kDescriptorColumns && std::find(chosen.begin(), chosen.end(), name) == chosen.end())
      chosen.push_back(name);
  };
  for (const char* stem : {"sphericity", "convexity", "elongation", "flatness"}) {
    const auto first = std::find_if(known.begin(), known.end(), [&](const auto& n) { return n.starts_with(stem); });
    if (first != known.end()) choose(*first);
  }
  for (const std::string& name : known) choose(name);
  return chosen;
}

/// By the sides of the box of least volume; none where they were not measured.
std::optional<std::string> zingg_name(const ShapeSummary& shape) {
  const auto s_over_i = shape.descriptors.find("zingg_s_over_i"), i_over_l = shape.descriptors.find("zingg_i_over_l");
  if (s_over_i == shape.descriptors.end() || i_over_l == shape.descriptors.end()) return std::nullopt;
  return kZinggClasses[zingg_class(s_over_i->second, i_over_l->second)];
}

Json levels_json(const ShapeSummary& shape) {
  Json levels = Json::array();
  const std::vector<bool> front = on_front(shape.levels);
  std::size_t k = 0;
  for (const Level& level : shape.levels)
    levels.push_back({{"mode", mode_name(level.key.mode)},
                      {"parts_asked", level.key.parts_asked},
                      {"parts", level.parts},
                      {"vertex_cap", level.key.vertex_cap},
                      {"face_cap", level.key.face_cap},
                      {"vertices", level.vertices},
                      {"faces", level.faces},
                      {"contact_cost", contact_cost(level)},
                      {"on_front", static_cast<bool>(front[k++])},
                      {"error", error_json(level.error)}});
  return levels;
}

std::string finished(const char* key, Json value) {
  const Json object{{"format", kJsonFormat}, {key, std::move(value)}};
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Row key_cells(const Level& level) {
  return {"  " + std::to_string(level.key.parts_asked), std::to_string(level.key.vertex_cap),
          level.key.face_cap > 0 ? std::to_string(level.key.face_cap) : "-", mode_name(level.key.mode)};
}

std::string levels_table(const ShapeSummary& summary) {
  std::vector<Row> rows{{"  parts", "vertices<=", "faces<=", "mode", "kept", "faces", "cost", "front", "sym.difference",
                         "+-", "missing", "volume", "centre", "inertia", "convexity", "overlap"}};
  const std::vector<bool> front = on_front(summary.levels);
  for (std::size_t k = 0; k < summary.levels.size(); ++k) {
    const Level& level = summary.levels[k];
    const catalog::DecompositionError& error = level.error;
    Row row = key_cells(level);
    row.insert(row.end(), {std::to_string(level.parts), std::to_string(level.faces), figure(contact_cost(level)),
                           front[k] ? "*" : "-"});
    for (const double value : {error.symmetric_difference, error.method_error, error.missing_volume, error.volume_error,
                               error.centre_error, error.inertia_error, error.convexity_error, error.overlap})
      row.push_back(figure(value));
    rows.push_back(row);
  }
  return table(rows);
}

std::string surfaces_table(const ShapeSummary& summary) {
  std::vector<Row> rows{{"  parts", "vertices<=", "faces<=", "mode", "mean", "95 %", "max", "from mesh: mean", "95 %",
                         "max", "from parts: mean", "95 %", "max"}};
  for (const Level& level : summary.levels) {
    Row row = key_cells(level);
    for (const catalog::SurfaceDistance& surface :
         {level.error.surface, level.error.surface_from_mesh, level.error.surface_from_union})
      for (const double value : {surface.mean, surface.percentile_95, surface.largest}) row.push_back(figure(value));
    rows.push_back(row);
  }
  return table(rows);
}

}  // namespace

double equivalent_diameter(double volume) { return std::cbrt(6 * volume / std::numbers::pi); }

std::string list_text(const std::vector<ShapeSummary>& shapes) {
  const std::vector<std::string> descriptors = columns_for(shapes);
  Row header{"name", "grade", "volume[mm3]", "d_eq[mm]", "faces"};
  header.insert(header.end(), descriptors.begin(), descriptors.end());
  header.insert(header.end(), {"zingg", "levels", "failed checks"});
  std::vector<Row> rows{header};
  for (const ShapeSummary& shape : shapes) {
    Row row{shape.name, std::to_string(shape.grade), figure(shape.volume * 1e9),
            figure(equivalent_diameter(shape.volume) * 1e3), std::to_string(shape.face_count)};
    for (const std::string& name : descriptors) {
      const auto found = shape.descriptors.find(name);
      row.push_back(found == shape.descriptors.end() ? "-" : figure(found->second));
    }
    row.push_back(zingg_name(shape).value_or("-"));
    row.push_back(joined(level_names(shape)));
    row.push_back(joined(shape.failed_checks));
    rows.push_back(row);
  }
  return table(rows);
}

std::string list_json(const std::vector<ShapeSummary>& shapes) {
  Json list = Json::array();
  for (const ShapeSummary& shape : shapes) {
    const std::optional<std::string> zingg = zingg_name(shape);
    list.push_back({{"id", shape.id},
                    {"name", shape.name},
                    {"grade", shape.grade},
                    {"volume", shape.volume},
                    {"equivalent_diameter", equivalent_diameter(shape.volume)},
                    {"face_count", shape.face_count},
                    {"descriptors", shape.descriptors},
                    {"zingg_class", zingg ? Json(*zingg) : Json()},
                    {"levels", levels_json(shape)},
                    {"failed_checks", shape.failed_checks}});
  }
  return finished("shapes", list);
}

std::string show_text(const catalog::ShapeRecord& shape, const ShapeSummary& summary) {
  const catalog::MassProperties& mass = shape.mass_properties;
  const auto triple = [](const catalog::Point& p) { return figure(p[0]) + " " + figure(p[1]) + " " + figure(p[2]); };
  std::string text = shape.name + "\n";
  text += "  volume               " + figure(mass.volume * 1e9) + " mm3, equivalent diameter " +
          figure(equivalent_diameter(mass.volume) * 1e3) + " mm\n";
  text += "  mesh                 " + std::to_string(shape.mesh.vertex_count()) + " vertices, " +
          std::to_string(shape.mesh.face_count()) + " faces\n";
  text += "  centroid             " + triple(mass.centroid) + " m\n";
  text += "  principal inertia    " + triple(mass.principal_inertia) + " m5 (density 1)\n";
  text +=
      "  grade                " + std::to_string(summary.grade) + ": " + catalog::grade_meaning(summary.grade) + "\n";
  text += "provenance\n";
  text += "  source               " + shape.provenance.source_file + "\n";
  text += "  sha256               " + shape.provenance.source_sha256 + "\n";
  text += "  made by              " + shape.provenance.tool_version + "\n";
  text += "  options              " + shape.provenance.options + "\n";

  text += "checks\n";
  std::vector<Row> rows{{"  name", "result", "figure", "expected"}};
  for (const catalog::Check& check : shape.checks)
    rows.push_back({"  " + check.name, check.passed ? "passed" : "FAILED", figure(check.figure), check.detail});
  text += shape.checks.empty() ? "  none\n" : table(rows);

  text += "descriptors\n";
  rows = {{"  name", "value"}};
  for (const auto& [name, value] : shape.descriptors) rows.push_back({"  " + name, figure(value)});
  text += shape.descriptors.empty() ? "  none\n" : table(rows);

  text += "levels of detail (volumes over the mesh's volume, distances over its bounding-box diagonal)\n";
  if (summary.levels.empty()) return text + "  none; run talus decompose\n";
  text += levels_table(summary);
  text += "distances between the surfaces (both ways, from points of the mesh, from points of the parts)\n";
  text += surfaces_table(summary);
  return text;
}

std::string show_json(const catalog::ShapeRecord& shape, const ShapeSummary& summary) {
  Json checks = Json::array();
  for (const catalog::Check& check : shape.checks)
    checks.push_back(
        {{"name", check.name}, {"passed", check.passed}, {"figure", check.figure}, {"detail", check.detail}});
  const catalog::MassProperties& mass = shape.mass_properties;
  return finished("shape", {{"id", summary.id},
                            {"name", shape.name},
                            {"grade", summary.grade},
                            {"vertex_count", shape.mesh.vertex_count()},
                            {"face_count", shape.mesh.face_count()},
                            {"volume", mass.volume},
                            {"equivalent_diameter", equivalent_diameter(mass.volume)},
                            {"centroid", mass.centroid},
                            {"principal_inertia", mass.principal_inertia},
                            {"principal_axes", mass.principal_axes},
                            {"provenance",
                             {{"source_file", shape.provenance.source_file},
                              {"source_sha256", shape.provenance.source_sha256},
                              {"tool_version", shape.provenance.tool_version},
                              {"options", shape.provenance.options}}},
                            {"checks", checks},
                            {"descriptors", shape.descriptors},
                            {"levels", levels_json(summary)}});
}

std::string names_json(const std::vector<ShapeSummary>& shapes) {
  Json list = Json::array();
  for (const ShapeSummary& shape : shapes) list.push_back({{"id", shape.id}, {"name", shape.name}});
  return finished("shapes", list);
}

std::string rejected_text(const std::vector<catalog::RejectedInput>& rejected) {
  std::vector<Row> rows{{"name", "source", "reason"}};
  for (const catalog::RejectedInput& input : rejected) rows.push_back({input.name, input.source_file, input.reason});
  return table(rows);
}

std::string rejected_json(const std::vector<catalog::RejectedInput>& rejected) {
  Json list = Json::array();
  for (const catalog::RejectedInput& input : rejected)
    list.push_back({{"name", input.name},
                    {"source_file", input.source_file},
                    {"source_sha256", input.source_sha256},
                    {"reason", input.reason}});
  return finished("rejected", list);
}

}  // namespace workflows
