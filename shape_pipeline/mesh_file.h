// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Reads STL, OBJ, OFF (assimp), PLY, or a planetary shape table with rows "v x y z" and "f i j k" (.tab, counted from
/// 1); polygons become triangles. Coordinates are multiplied by `metres_per_unit`. The mesh comes as it stands: not
/// welded, not repaired. Throws InputError for a bad file: missing, empty, truncated, of another kind, with coordinates
/// that are no numbers, indices out of range, all vertices in one plane.
catalog::TriangleMesh read_mesh(const std::filesystem::path& path, double metres_per_unit);

/// Writes a binary STL in the mesh's own unit.
void write_stl(const std::filesystem::path& path, const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
