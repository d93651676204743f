// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// For each vertex the way to the convex hull of all, n_vertices [m]: the mean of the ways d_i n_i onto the planes of
/// the hull's facets, weighted by 1 / d_i^4. It is the way to the nearest facet near the hull and turns over smoothly
/// between facets in a hollow; a vertex of the hull has none.
std::vector<catalog::Point> ways_to_hull(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
