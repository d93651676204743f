// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/reading/folder_files.h"

#include <algorithm>

#include "shape_pipeline/stack_sources.h"

namespace shape_pipeline {
namespace {

/// Whether `a` comes before `b` where runs of digits count as numbers.
bool natural_order(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto run_end = [&](const std::string& text, std::size_t i) {
    while (i < text.size() && is_digit(text[i])) ++i;
    return i;
  };
  const auto without_zeros = [](std::string digits) {
    return digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::size_t end_a = run_end(a, i), end_b = run_end(b, j);
      const std::string m = without_zeros(a.substr(i, end_a - i)), n = without_zeros(b.substr(j, end_b - j));
      if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
      i = end_a;
      j = end_b;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

}  // namespace

std::vector<std::filesystem::path> files_in_natural_order(const std::filesystem::path& folder,
                                                          const std::vector<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::find(endings.begin(), endings.end(), lower_ending(entry.path())) != endings.end())
      files.push_back(entry.path());
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return natural_order(a.filename().string(), b.filename().string()); });
  return files;
}

}  // namespace shape_pipeline
