// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/shape_record.h"

namespace shape_pipeline {

/// Distance [m] of each point to the nearest triangle of the mesh.
std::vector<double> distances_to_surface(const std::vector<catalog::Point>& points, const catalog::TriangleMesh& mesh);

/// The same with a sign: positive on the side that the triangle's normal points to.
std::vector<double> signed_distances_to_surface(const std::vector<catalog::Point>& points,
                                                const catalog::TriangleMesh& mesh);

/// Mean, 95 % and largest of distances without sign, over a diagonal of the same unit. Zeros if there are none.
catalog::SurfaceDistance distance_statistics(std::vector<double> distances, double diagonal);

}  // namespace shape_pipeline
