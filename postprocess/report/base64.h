// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace postprocess {

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// The values' bytes as they lie in memory (little-endian machines only, as is all that Talus builds on).
template <class T>
std::string base64_of(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace postprocess
