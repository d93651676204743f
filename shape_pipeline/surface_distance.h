// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Distance [m] of each point to the nearest triangle of the mesh.
std::vector<double> distances_to_surface(const std::vector<catalog::Point>& points, const catalog::TriangleMesh& mesh);

/// The same with a sign: positive on the side that the triangle's normal points to.
std::vector<double> signed_distances_to_surface(const std::vector<catalog::Point>& points,
                                                const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
