// SPDX-License-Identifier: Apache-2.0
#include "workflows/population/form_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "catalog/input_error.h"
#include "workflows/text_format.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using catalog::InputError;

constexpr std::size_t kFewestGrains = 10;  // of fewer, spread and correlation tell nothing
constexpr double kMostRatio = 1.5;        // voxel data have sphericities a little above 1; beyond, it is another figure
constexpr double kRatioTolerance = 1e-3;  // of Flatness and Elongation against axes written with few digits

constexpr char kSandAtlasAxes[] =
    "S, I, L of the reference taken for axes of the ellipsoid of equal second moments (Sand Atlas scales that "
    "ellipsoid "
    "to the grain's volume, which leaves its ratios)";
constexpr char kTalusAxes[] = "S, I, L: axes of the ellipsoid of equal second moments, as axis_short_inertia is";

enum Axis : std::size_t { kMinor = kFormFigures, kMiddle, kMajor, kColumns };

struct Heading {
  std::string_view name;
  std::size_t column;
  double unit;  // if none stands beside it; 0: one must
  bool is_length = false;
};
constexpr Heading kHeadings[] = {
    {"Equivalent Diameter", kDiameter, 0, true},
    {"Flatness", kSOverI, 1},
    {"Elongation", kIOverL, 1},
    {"Convexity", kConvexity, 1},
    {"True Sphericity", kSphericity, 1},
    {"Minor Axis Length", kMinor, 0, true},
    {"Middle Axis Length", kMiddle, 0, true},
    {"Major Axis Length", kMajor, 0, true},
    {kFormNames[kDiameter], kDiameter, 1, true},
    {kFormNames[kSOverI], kSOverI, 1},
    {kFormNames[kIOverL], kIOverL, 1},
    {kFormNames[kConvexity], kConvexity, 1},
    {kFormNames[kSphericity], kSphericity, 1},
};

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r' || letter == '"'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

/// "µm" in both of Unicode's spellings.
std::string plain_unit(std::string_view unit) {
  for (const std::string_view micro : {"\u00b5", "\u03bc"})
    if (unit.starts_with(micro)) return "u" + std::string(unit.substr(micro.size()));
  return std::string(unit);
}

struct Column {
  std::size_t cell = 0;
  double unit = 0;  // to SI; 0: there is no such column
  std::string heading;
};
using Columns = std::array<Column, kColumns>;

/// A heading with its unit in brackets, "Convexity (-)" or "Equivalent Diameter [mm]".
void take_heading(const std::string& file, std::string_view cell, std::size_t place, Columns& columns) {
  const std::size_t bracket = cell.find_first_of("([");
  const std::string_view name = trimmed(cell.substr(0, bracket));
  const auto* const known = std::find_if(std::begin(kHeadings), std::end(kHeadings),
                                         [&](const Heading& heading) { return heading.name == name; });
  if (known == std::end(kHeadings)) return;
  Column column{place, known->unit, std::string(cell)};
  if (bracket != std::string_view::npos) {
    const std::string unit = plain_unit(cell.substr(bracket + 1, cell.find_first_of(")]") - bracket - 1));
    const std::optional<double> factor = known->is_length ? length_unit(unit)
                                         : unit == "-"    ? std::optional(1.0)
                                         : unit == "%"    ? std::optional(0.01)
                                                          : std::nullopt;
    if (!factor)
      throw InputError(file + ": column '" + column.heading + "' has the unit '" + unit + "', expected one of " +
                       (known->is_length ? accepted_units(Dimension::length) : std::string("-, %")));
    column.unit = *factor;
  }
  if (column.unit == 0)
    throw InputError(file + ": column '" + column.heading + "' has no unit; write it behind it, such as '" +
                     std::string(name) + " (um)'");
  if (columns[known->column].unit != 0)
    throw InputError(file + ": columns '" + columns[known->column].heading + "' and '" + column.heading +
                     "' are one figure; keep one of them");
  columns[known->column] = column;
}

Columns columns_of(const std::string& file, std::string_view headings) {
  if (headings.starts_with("\ufeff")) headings.remove_prefix(std::string_view("\ufeff").size());
  Columns columns;
  std::size_t place = 0;
  for (const std::string_view cell : cells_of(headings)) take_heading(file, cell, place++, columns);
  std::string missing;
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    if (columns[c].unit != 0) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(kFormNames[c]);
    for (const Heading& heading : kHeadings)
      if (heading.column == c && heading.name != kFormNames[c])
        missing += " (or '" + std::string(heading.name) + (heading.is_length ? " (um)')" : " (-)')");
  }
  if (!missing.empty())
    throw InputError(file + ": its first line has no column for " + missing +
                     "; name the columns so, with commas between");
  return columns;
}

/// One line of the file, for messages too.
struct Line {
  std::string file;
  std::size_t number = 0;
  std::string_view text;

  std::string place() const { return file + ", line " + std::to_string(number) + ": "; }
};

double number_in(const Line& line, const std::vector<std::string_view>& cells, const Column& column) {
  if (column.cell >= cells.size())
    throw InputError(line.place() + formatted("has %zu cells, and '%s' is column %zu; complete the line or delete it",
                                              cells.size(), column.heading.c_str(), column.cell + 1));
  const std::string_view cell = cells[column.cell];
  double value = 0;
  const auto [rest, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || rest != cell.data() + cell.size() || !std::isfinite(value))
    throw InputError(line.place() + "column '" + column.heading + "': expected a number, found '" + std::string(cell) +
                     "'; mend the line or delete it");
  return value * column.unit;
}

void refuse_impossible(const std::string& place, const FormRow& row) {
  for (std::size_t c = 0; c < kFormFigures; ++c) {
    const double most = c == kDiameter ? 1e12 : c == kConvexity || c == kSphericity ? kMostRatio : 1;
    if (!(row[c] > 0 && row[c] <= most))
      throw InputError(place +
                       formatted("%s is %g, expected %s; another formula or unit?", kFormNames[c], row[c],
                                 c == kDiameter ? "a length above 0" : formatted("above 0 to %g", most).c_str()));
  }
}

/// Flatness and Elongation are S/I and I/L only in some files: the axes beside them tell.
void refuse_other_formulas(const Line& line, const std::vector<std::string_view>& cells, const Columns& columns,
                           const FormRow& row) {
  for (const auto& [ratio, small, large] :
       {std::array{std::size_t{kSOverI}, std::size_t{kMinor}, std::size_t{kMiddle}},
        std::array{std::size_t{kIOverL}, std::size_t{kMiddle}, std::size_t{kMajor}}}) {
    if (columns[small].unit == 0 || columns[large].unit == 0) continue;
    const double expected = number_in(line, cells, columns[small]) / number_in(line, cells, columns[large]);
    if (!(std::abs(row[ratio] - expected) <= kRatioTolerance))
      throw InputError(line.place() + formatted("'%s' is %g, but '%s' over '%s' is %g: another formula of that name; "
                                                "name the column with these ratios %s",
                                                columns[ratio].heading.c_str(), row[ratio],
                                                columns[small].heading.c_str(), columns[large].heading.c_str(),
                                                expected, kFormNames[ratio]));
  }
}

FormTable csv_table(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  const std::string file = path.string();
  if (!std::getline(stream, text))
    throw InputError(file +
                     ": is empty or cannot be read, expected a CSV file with a line of headings, or a catalogue");
  const Columns columns = columns_of(file, text);
  FormTable table{path.filename().string(),
                  catalog::sha256_of_file(path),
                  columns[kSOverI].heading.starts_with("Flatness") ? kSandAtlasAxes : kTalusAxes,
                  {}};
  for (std::size_t number = 2; std::getline(stream, text); ++number) {
    if (trimmed(text).empty()) continue;
    const Line line{file, number, text};
    const std::vector<std::string_view> cells = cells_of(text);
    FormRow row;
    for (std::size_t c = 0; c < kFormFigures; ++c) row[c] = number_in(line, cells, columns[c]);
    refuse_impossible(line.place(), row);
    refuse_other_formulas(line, cells, columns, row);
    table.rows.push_back(row);
  }
  return table;
}

void refuse_few(const FormTable& table, const std::string& file) {
  if (table.rows.size() < kFewestGrains)
    throw InputError(file + formatted(": has %zu grains, expected %zu at least to tell a distribution",
                                      table.rows.size(), kFewestGrains));
}

bool is_catalogue(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string begin(15, '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "SQLite format 3";
}

}  // namespace

FormRow form_row(const std::string& shape, const std::map<std::string, double>& descriptors) {
  const auto figure = [&](const char* name) {
    const auto found = descriptors.find(name);
    if (found == descriptors.end())
      throw InputError(shape + ": has no descriptor " + name +
                       "; make or digitise it again, or leave it out by --select");
    return found->second;
  };
  const double intermediate = figure("axis_intermediate_inertia");
  return {figure(kFormNames[kDiameter]), figure("axis_short_inertia") / intermediate,
          intermediate / figure("axis_long_inertia"), figure(kFormNames[kConvexity]), figure(kFormNames[kSphericity])};
}

FormTable form_table(const catalog::ShapeCatalog& catalog, const std::string& select, const fs::path& file) {
  FormTable table{file.filename().string(), "", kTalusAxes, {}};
  for (const catalog::ShapeId id : catalog.select(select)) {
    const catalog::ShapeSummary shape = catalog.summary(id);
    table.rows.push_back(form_row(shape.name, shape.descriptors));
    refuse_impossible(shape.name + ": ", table.rows.back());
  }
  refuse_few(table, file.string());
  table.sha256 = catalog::sha256(table.rows.data(), table.rows.size() * sizeof(FormRow));
  return table;
}

FormTable read_form_table(const fs::path& file, const std::string& select) {
  if (!fs::is_regular_file(file))
    throw InputError(file.string() + ": there is no such file, expected a CSV file of descriptors or a catalogue");
  if (is_catalogue(file))
    return form_table(catalog::ShapeCatalog(file, catalog::ShapeCatalog::Access::read_only), select, file);
  if (!select.empty()) throw catalog::UsageError("a selection goes with a catalogue; " + file.string() + " is none");
  const FormTable table = csv_table(file);
  refuse_few(table, file.string());
  return table;
}

}  // namespace workflows
