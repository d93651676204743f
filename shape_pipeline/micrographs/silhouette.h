// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

/// Silhouette of a mesh that is star-shaped about the origin, seen along a unit vector: itself star-shaped, so that it
/// is the farthest edge along each of `rays` directions, evenly turned.
Outline star_silhouette(const catalog::TriangleMesh& mesh, const catalog::Point& view, int rays);

/// Radii of an outline about a centre inside, along directions evenly turned: the farthest crossing of each.
std::vector<double> ray_radii(const Outline& outline, const PlanePoint& centre, int rays);

}  // namespace shape_pipeline
