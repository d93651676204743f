// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace shape_pipeline {

enum class ScanKind { point_cloud, mesh };

/// By the file's ending; a PLY is a mesh if its header declares faces. Throws InputError for an ending that is not
/// read.
ScanKind scan_kind(const std::filesystem::path& path);

/// True if the ending is one of a scan file.
bool has_scan_ending(const std::filesystem::path& path);

/// The inputs with each folder replaced by the scan files in it (not in its subfolders), sorted by name; what has such
/// an ending but is no file (a link that leads nowhere, a pipe) is listed too, for its reader to refuse by name. Throws
/// InputError for a folder without any.
std::vector<std::filesystem::path> scan_files(const std::vector<std::filesystem::path>& inputs);

}  // namespace shape_pipeline
