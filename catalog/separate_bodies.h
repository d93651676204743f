// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace catalog {

/// What becomes of surfaces that lie apart from one another.
enum class SeparateBodies {
  join,     // all are one rigid body
  largest,  // only that one is kept
  refuse
};

/// The word for each, in the order of the enumeration.
inline const std::vector<std::string>& separate_bodies_names() {
  static const std::vector<std::string> names{"join", "largest", "refuse"};
  return names;
}

inline const std::string& separate_bodies_name(SeparateBodies bodies) {
  return separate_bodies_names()[static_cast<std::size_t>(bodies)];
}

}  // namespace catalog
