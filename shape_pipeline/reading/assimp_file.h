// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// All triangles of a file as assimp reads them, in the file's unit; `format` is "stl", "obj" or "off". Throws
/// InputError if assimp fails, or if its single precision would blur a mesh that lies far from the origin.
catalog::TriangleMesh read_with_assimp(const std::filesystem::path& path, std::string_view bytes,
                                       const std::string& format);

}  // namespace shape_pipeline
