// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

/// A Markdown table on stdout, one line a row as it becomes known. docs/accuracy.md is made of these: its command runs
/// the validation tests and keeps the lines that start with "### " or "|".
class AccuracyTable {
 public:
  AccuracyTable(const std::string& title, const std::vector<std::string>& columns) {
    std::printf("\n### %s\n\n", title.c_str());
    print(columns);
    print(std::vector<std::string>(columns.size(), "---"));
  }

  /// One cell a column; numbers as text(value).
  void row(const std::vector<std::string>& cells) const { print(cells); }

  static std::string text(double value, const char* format = "%.4g") {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
  }

 private:
  static void print(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    std::printf("%s\n", line.c_str());
  }
};

}  // namespace test_support
