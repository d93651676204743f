// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shape_pipeline {

/// The text of a JSON object in a file beside a scan, checked: parsing it again does not fail. Throws InputError, which
/// ends with `example`, for what is no JSON object, and for a key that is not `known`, naming the nearest that is;
/// `what`: of what the keys are, such as "a sidecar".
std::string read_sidecar_json(const std::filesystem::path& path, const std::vector<std::string>& known,
                              const std::string& what, const std::string& example);

}  // namespace shape_pipeline
