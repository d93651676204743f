// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Pairs of faces of an oriented manifold that cut one another, beyond a shared corner or edge.
std::size_t count_self_intersections(const catalog::TriangleMesh& mesh);

/// Smooths or recuts the surface around faces that cut one another. The mesh may change anywhere near them; the caller
/// checks the result.
catalog::TriangleMesh without_self_intersections(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
