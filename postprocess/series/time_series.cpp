// SPDX-License-Identifier: Apache-2.0
#include "postprocess/time_series.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>

#include "catalog/input_error.h"

namespace postprocess {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line, const std::string& what) {
  throw catalog::InputError(file.string() + ": line " + std::to_string(line) + ": " + what);
}

/// Whole lines of a file: what follows the last line end is not yet a line.
std::vector<std::string> whole_lines(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw catalog::InputError(file.string() + ": cannot be read; expected a CSV table of a Talus run");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin)) {
    lines.push_back(text.substr(begin, end - begin));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
  }
  return lines;
}

/// Splits at commas outside double quotes; "" within quotes is one quote. Nullopt if a quote is not closed.
std::optional<std::vector<std::string>> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (is_quoted) return std::nullopt;
  return fields;
}

/// Header of the file: numeric columns, and where the key column is.
struct Header {
  std::vector<SeriesColumn> columns;  // without the key
  std::optional<std::size_t> key_index;
  std::size_t field_count = 0;
};

Header parse_header(const std::filesystem::path& file, const std::string& line, const std::string& key) {
  const auto fields = split_fields(line);
  if (!fields) refuse(file, 1, "a quote is not closed");
  Header header;
  header.field_count = fields->size();
  for (std::size_t i = 0; i < fields->size(); ++i) {
    const std::string& field = (*fields)[i];
    if (!key.empty() && field == key) {
      header.key_index = i;
      continue;
    }
    const std::size_t open = field.find('[');
    if (open == 0 || open == std::string::npos || field.back() != ']')
      refuse(file, 1, "header \"" + field + "\": expected name[unit], as in time[s]");
    header.columns.push_back({field.substr(0, open), field.substr(open + 1, field.size() - open - 2), {}});
  }
  if (header.columns.empty() || header.columns.front().name != "time")
    refuse(file, 1, "expected time[s] as the first column");
  if (!key.empty() && !header.key_index) refuse(file, 1, "expected a column \"" + key + "\"");
  return header;
}

double parse_number(const std::filesystem::path& file, std::size_t line, const std::string& field,
                    const SeriesColumn& column) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
    refuse(file, line, "column " + column.name + ": expected a finite number, found \"" + field.substr(0, 40) + "\"");
  return value;
}

/// Calls row(key, values) for each data line; returns the header.
Header for_each_row(const std::filesystem::path& file, const std::string& key,
                    const std::function<void(const Header&, std::size_t line, const std::string& key,
                                             const std::vector<double>& values)>& row) {
  const std::vector<std::string> lines = whole_lines(file);
  if (lines.empty()) throw catalog::InputError(file.string() + ": empty; expected a CSV table of a Talus run");
  const Header header = parse_header(file, lines.front(), key);
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const auto fields = split_fields(lines[l]);
    if (!fields) refuse(file, l + 1, "a quote is not closed");
    if (fields->size() != header.field_count)
      refuse(file, l + 1,
             "expected " + std::to_string(header.field_count) + " fields, found " + std::to_string(fields->size()));
    std::vector<double> values;
    std::string row_key;
    for (std::size_t i = 0; i < fields->size(); ++i) {
      if (header.key_index == i)
        row_key = (*fields)[i];
      else
        values.push_back(parse_number(file, l + 1, (*fields)[i], header.columns[values.size()]));
    }
    row(header, l + 1, row_key, values);
  }
  return header;
}

void append_row(const std::filesystem::path& file, std::size_t line, TimeSeries& series,
                const std::vector<double>& values) {
  if (series.row_count() > 0 && values[0] < series.columns[0].values.back())
    refuse(file, line, "time goes back; expected rows in order of time");
  for (std::size_t c = 0; c < values.size(); ++c) series.columns[c].values.push_back(values[c]);
}

}  // namespace

bool TimeSeries::has(const std::string& name) const {
  for (const SeriesColumn& column : columns)
    if (column.name == name) return true;
  return false;
}

const std::vector<double>& TimeSeries::at(const std::string& name) const {
  for (const SeriesColumn& column : columns)
    if (column.name == name) return column.values;
  throw catalog::InputError(source + ": line 1: no column \"" + name + "\"; was this written by an older Talus?");
}

TimeSeries read_time_series(const std::filesystem::path& file) {
  TimeSeries series;
  const Header header = for_each_row(
      file, "", [&](const Header& head, std::size_t line, const std::string&, const std::vector<double>& values) {
        if (series.columns.empty()) series.columns = head.columns;
        append_row(file, line, series, values);
      });
  if (series.columns.empty()) series.columns = header.columns;
  series.source = file.string();
  return series;
}

std::map<std::string, TimeSeries> read_grouped_series(const std::filesystem::path& file, const std::string& key) {
  std::map<std::string, TimeSeries> groups;
  for_each_row(file, key,
               [&](const Header& head, std::size_t line, const std::string& name, const std::vector<double>& values) {
                 TimeSeries& series = groups[name];
                 if (series.columns.empty()) {
                   series.columns = head.columns;
                   series.source = file.string();
                 }
                 append_row(file, line, series, values);
               });
  return groups;
}

}  // namespace postprocess
