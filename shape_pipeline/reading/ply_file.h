// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// What a PLY file holds for us, in the file's unit.
struct PlyContents {
  std::vector<catalog::Point> points;            // n_vertices x 3
  std::vector<catalog::Point> normals;           // n_vertices x 3, or empty
  std::vector<std::vector<std::int64_t>> faces;  // polygons: indices as they stand in the file
  std::size_t vertex_count = 0;                  // of the file
};

/// Number of faces that the header declares: a PLY with faces is a mesh, without a cloud.
std::size_t ply_face_count(const std::filesystem::path& path);

/// Reads an ASCII or binary PLY of either byte order. Throws InputError for a header that is none, missing x, y, z, and
/// a body that is shorter or longer than the header says. Of more vertices than the limit a sample is kept.
PlyContents read_ply(const std::filesystem::path& path,
                     std::size_t vertex_limit = std::numeric_limits<std::size_t>::max());

}  // namespace shape_pipeline
