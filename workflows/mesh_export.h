// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/triangle_mesh.h"

namespace workflows {

/// Triangles with the part each belongs to; `part` is empty for a mesh that is not cut.
struct ExportMesh {
  catalog::TriangleMesh mesh;  // [m]
  std::vector<int> part;       // n_faces, index of the part
};

/// Each part a closed surface of its own, inner faces included.
ExportMesh joined(const std::vector<catalog::ConvexPart>& parts);

/// The bytes of a file: STL binary (float32, so coordinates are rounded), PLY binary (float64, a part number on each
/// face if there are parts), OFF text (17 digits: every double comes back).
std::string stl_bytes(const ExportMesh& shape);
std::string ply_bytes(const ExportMesh& shape);
std::string off_bytes(const ExportMesh& shape);

/// Writes beside `path`, flushes, renames: a reader sees the old file or the new one whole. InputError if the folder
/// cannot be written.
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace workflows
