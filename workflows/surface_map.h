// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace workflows {

/// Writes the mesh with one number a vertex as a VTP file (text) that ParaView reads. Throws InputError where it cannot
/// be written.
void write_surface_map(const std::filesystem::path& path, const catalog::TriangleMesh& mesh, const std::string& name,
                       const std::vector<double>& values);

}  // namespace workflows
