// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "workflows/bench/bench_plan.h"

namespace workflows {

/// A finished case as JSON, whole or not at all, so that a long bench that was stopped goes on where it was.
/// `made_with` says by what and of what it was measured: version, command, inputs.
void write_case(const std::filesystem::path& file, const std::string& made_with, const CaseResult& result);

/// nullopt if there is no such file, if it was made with something else, or if a run in it failed. Throws
/// catalog::InputError if it holds no case.
std::optional<CaseResult> read_case(const std::filesystem::path& file, const std::string& made_with);

}  // namespace workflows
