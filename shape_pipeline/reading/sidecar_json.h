// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace shape_pipeline {

/// The JSON object of a file beside a scan. Throws InputError, which ends with `example`, for what is no JSON object, and
/// for a key that is not `known`, naming the nearest that is; `what`: of what the keys are, such as "a sidecar".
nlohmann::json read_sidecar_json(const std::filesystem::path& path, const std::vector<std::string>& known,
                                 const std::string& what, const std::string& example);

}  // namespace shape_pipeline
