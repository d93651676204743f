// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/markdown_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace workflows {

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

}  // namespace workflows
