// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The k points nearest to each query, nearest first: n_queries x k indices into points (fewer if there are fewer
/// points). A query that is itself one of the points finds itself first.
std::vector<std::vector<int>> nearest_points(const std::vector<catalog::Point>& points,
                                             const std::vector<catalog::Point>& queries, int k);

}  // namespace shape_pipeline
