// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

namespace workflows {

inline constexpr const char* kPlainName = "a name must not be empty or hold control characters, '/', ',' or '\"'";

/// Fit for a cell of a CSV file and a part of a file's name. Letters of any alphabet are.
inline bool is_plain_name(const std::string& name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x20 || byte == 0x7f || letter == '/' || letter == ',' || letter == '"';
  });
}

/// For messages: in one line.
inline std::string shown_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; },
      '?');
  return "\"" + name + "\"";
}

}  // namespace workflows
