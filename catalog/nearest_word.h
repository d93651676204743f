// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace catalog {

/// Least number of letters inserted, removed or replaced to turn `a` into `b`, ignoring case (Levenshtein 1966).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i - 1]) != lower(b[j - 1]));
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

/// The known word that needs the fewest edits, the first of equals; nullopt where none is near: a slip of the pen
/// changes a third of the letters at most.
inline std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  if (nearest == known.end() || 3 * edit_distance(word, *nearest) > std::max(word.size(), nearest->size()) + 2)
    return std::nullopt;
  return *nearest;
}

/// 'a', 'b', 'c'.
inline std::string quoted_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "'" : ", '") + word + "'";
  return list;
}

/// For the end of a message about an unknown word: "did you mean 'x'?", or, where none is near, "known are 'a', 'b'.".
inline std::string word_hint(std::string_view word, const std::vector<std::string>& known) {
  if (const auto nearest = nearest_word(word, known)) return "did you mean '" + *nearest + "'?";
  return "known are " + quoted_list(known) + ".";
}

}  // namespace catalog
