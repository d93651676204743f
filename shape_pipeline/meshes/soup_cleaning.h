// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Joins vertices nearer than `tolerance` [m] (0: identical ones). Returns how many vertices were joined to another.
std::size_t weld_vertices(catalog::TriangleMesh& soup, double tolerance);

/// Vertices in order of their coordinates, faces from their lowest vertex and in order of these: the same mesh for the
/// same surface, whatever order an algorithm (or the addresses it works with) gave. Unused vertices go.
void put_in_canonical_order(catalog::TriangleMesh& mesh);

/// Removes faces with a repeated corner or without area. Returns how many.
std::size_t remove_degenerate_faces(catalog::TriangleMesh& soup);

/// Removes the faces of walls between closed surfaces: pairs on the same three vertices, turned against one another, in
/// a soup whose every edge is run along as often one way as the other, unless no face would be left. Returns how many.
std::size_t remove_shared_walls(catalog::TriangleMesh& soup);

/// Removes faces on the same three vertices as an earlier one. Returns how many.
std::size_t remove_duplicate_faces(catalog::TriangleMesh& soup);

}  // namespace shape_pipeline
