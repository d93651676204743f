// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace benchmark_counts {

/// Instructions that callgrind counts in a command [-]. `counts_from_start`: all of them, not only those between the
/// program's own marks. Throws std::runtime_error with the end of what valgrind said if the command fails.
double instructions_of(const std::vector<std::string>& command, bool counts_from_start,
                       const std::filesystem::path& work_folder);

}  // namespace benchmark_counts
