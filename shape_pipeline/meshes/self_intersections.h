// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Pairs of faces of an oriented manifold that cut or touch one another, beyond a shared corner or edge.
std::vector<std::pair<std::size_t, std::size_t>> self_intersecting_faces(const catalog::TriangleMesh& mesh);

/// How many pairs there are.
std::size_t count_self_intersections(const catalog::TriangleMesh& mesh);

/// Smooths or recuts the surface around faces that cut one another. The mesh may change anywhere near them; the caller
/// checks the result.
catalog::TriangleMesh without_self_intersections(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
