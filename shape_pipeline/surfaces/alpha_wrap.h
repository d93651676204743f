// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// Closed surface that encloses the points and triangles at the distance `offset` [m], carved by balls of radius
/// `alpha` [m] (Portaneri et al. 2022): gaps narrower than about 2 alpha stay shut.
catalog::TriangleMesh alpha_wrap(const std::vector<catalog::Point>& points, double alpha, double offset);
catalog::TriangleMesh alpha_wrap(const catalog::TriangleMesh& soup, double alpha, double offset);

}  // namespace shape_pipeline
