// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace postprocess {

/// One column of a table; the header was `name[unit]`.
struct SeriesColumn {
  std::string name;
  std::string unit;  // "s", "kg", "-", "N m"
  std::vector<double> values;
};

/// Table of numbers over time: equally long columns, finite values. Its first column is `time`, never falling.
struct TimeSeries {
  std::string source;  // file it came from, for messages
  std::vector<SeriesColumn> columns;

  std::size_t row_count() const { return columns.empty() ? 0 : columns.front().values.size(); }
  bool has(const std::string& name) const;
  /// The column's values; throws catalog::InputError naming the file if there is no such column.
  const std::vector<double>& at(const std::string& name) const;
};

/// Reads a CSV file with `name[unit]` headers. A last line without its line end is one that a run was still writing: it
/// is left out. Throws catalog::InputError with file and line for anything else that is not a table of finite numbers.
TimeSeries read_time_series(const std::filesystem::path& file);

/// Reads a CSV file in long form, in which the text column `key` tells the rows apart: one table per key, rows in the
/// file's order. Throws as read_time_series.
std::map<std::string, TimeSeries> read_grouped_series(const std::filesystem::path& file, const std::string& key);

}  // namespace postprocess
