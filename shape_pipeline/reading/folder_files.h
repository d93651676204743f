// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shape_pipeline {

/// The files of a folder with one of these endings (lower case, with the dot), in natural order: 2 before 10.
std::vector<std::filesystem::path> files_in_natural_order(const std::filesystem::path& folder,
                                                          const std::vector<std::string>& endings);

}  // namespace shape_pipeline
