// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// Moves the vertices of a closed mesh along their normals onto the oriented cloud, which takes back what a smoothing
/// reconstruction shrank. Each vertex goes to the weighted mean of its neighbours' distances, measured along the mean
/// of vertex and point normal, which has no error of second order on a curved surface. Where the cloud has a gap the
/// surface stays. `spacing` [m] is the cloud's average point distance.
catalog::TriangleMesh projected_to_cloud(const catalog::TriangleMesh& mesh, const PointCloud& cloud, double spacing);

}  // namespace shape_pipeline
