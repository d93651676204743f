// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace catalog {

/// What the parts of a level of detail are to the solid.
enum class FitMode {
  volume_true,  // the union has the mesh's volume, and the symmetric difference is least
  enclosing,    // nothing is missing: every point of the mesh lies in a part
  inscribed     // nothing sticks out of the mesh
};

/// The word for each mode, in the order of the enumeration, as options, scenes and catalogue files write it.
inline const std::vector<std::string>& mode_names() {
  static const std::vector<std::string> names{"volume-true", "enclosing", "inscribed"};
  return names;
}

inline const std::string& mode_name(FitMode mode) { return mode_names()[static_cast<std::size_t>(mode)]; }

inline std::optional<FitMode> mode_named(const std::string& name) {
  for (std::size_t i = 0; i < mode_names().size(); ++i)
    if (mode_names()[i] == name) return static_cast<FitMode>(i);
  return std::nullopt;
}

}  // namespace catalog
