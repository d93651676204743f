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

/// The mesh moved along its vertex normals by one distance for all, so that the cloud lies as much outside as inside
/// (area-weighted mean of the signed distances is zero). To first order that gives back the volume which a smoothing
/// reconstruction cut from edges, without following the noise.
catalog::TriangleMesh balanced_on_cloud(const catalog::TriangleMesh& mesh, const PointCloud& cloud, double spacing);

}  // namespace shape_pipeline
