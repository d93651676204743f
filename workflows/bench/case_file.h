// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "workflows/bench/bench_plan.h"

namespace workflows {

/// A finished case as JSON, whole or not at all, so that a long bench that was stopped goes on where it was.
void write_case(const std::filesystem::path& file, const CaseResult& result);

/// nullopt if there is no such file. Throws catalog::InputError if it holds no case.
std::optional<CaseResult> read_case(const std::filesystem::path& file);

}  // namespace workflows
