// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace workflows {

/// A stage of the front command: `talus NAME` starts the executable talus-NAME.
struct Stage {
  std::string name;
  std::string purpose;
};
const std::vector<Stage>& stages();

/// What `talus --help` prints; stages whose executable is not in `folder` are marked.
std::string front_help(const std::filesystem::path& folder);

/// The executable of a stage in `folder`. Throws UsageError for an unknown stage, naming the nearest, and for one that
/// is not built.
std::filesystem::path stage_executable(const std::filesystem::path& folder, const std::string& stage);

}  // namespace workflows
