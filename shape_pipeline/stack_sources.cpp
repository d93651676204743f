// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/stack_sources.h"

#include <algorithm>
#include <cctype>

#include "shape_pipeline/reading/scan_bytes.h"

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

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool has_stack_ending(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".tif" || ending == ".tiff" || ending == ".nrrd" || ending == ".raw";
}

std::vector<std::filesystem::path> stack_sources(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) {
    if (lower_ending(path) != ".raw") return {path};
    return {path, std::filesystem::path(path).replace_extension(".json")};
  }
  std::vector<std::filesystem::path> slices;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (lower_ending(entry.path()) == ".tif" || lower_ending(entry.path()) == ".tiff") slices.push_back(entry.path());
  if (slices.empty()) refuse_file(path, "", "no TIFF slices in this folder", "put one TIFF a slice there");
  std::sort(slices.begin(), slices.end(),
            [](const auto& a, const auto& b) { return natural_order(a.filename().string(), b.filename().string()); });
  return slices;
}

}  // namespace shape_pipeline
