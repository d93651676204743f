// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// A patch of surface shrunk to a point.
struct SurfaceElement {
  catalog::Point centre;  // [m]
  catalog::Point area;    // normal times area, outward [m2]
};

/// A triangle soup cut into elements no longer than 1/48 of its longest side (longer where they would be too many).
std::vector<SurfaceElement> surface_samples(const catalog::TriangleMesh& soup);

/// Elements of a triangle soup: exact areas; large triangles are split, close ones merged, so that about `limit`
/// remain.
std::vector<SurfaceElement> surface_elements(const catalog::TriangleMesh& soup, int limit);

/// Elements of an oriented cloud: each point stands for the area pi r_k^2 / k of its k nearest neighbours.
std::vector<SurfaceElement> surface_elements(const PointCloud& cloud, int limit);

/// Volume [m3] where the generalised winding number of the elements (Jacobson et al. 2013; point form of Barill et al.
/// 2018) exceeds half its value inside, by midpoint cells. It needs no closed surface: gaps and holes are spanned
/// smoothly, so it is a second method beside any reconstruction. Accurate to about 1 %. Zero if nothing is inside.
double winding_volume(const std::vector<SurfaceElement>& elements);

}  // namespace shape_pipeline
