// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// Sizes of the Poisson surface mesh, in units of the cloud's spacing.
struct PoissonResolution {
  double facet_radius = 2.0;    // largest circumradius of a facet
  double facet_distance = 0.1;  // largest distance of a facet to the implicit surface
};

/// Zero level of the Poisson indicator function (Kazhdan, Bolitho & Hoppe 2006) of a cloud with oriented normals, by
/// Delaunay refinement. Empty if the solver or the mesher fails. `spacing` [m] is the cloud's average point distance.
catalog::TriangleMesh poisson_surface(const PointCloud& cloud, double spacing, const PoissonResolution& resolution);

}  // namespace shape_pipeline
