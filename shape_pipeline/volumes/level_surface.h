// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// The surface where a field on a grid (grid.count() values, inside above 0, negative on the grid's faces) is 0:
/// marching tetrahedra on the six tetrahedra of a cell about its diagonal (Kuhn's subdivision; Doi & Koide 1991), whose
/// surface is a closed manifold for any field, which that of marching cubes is not: there four triangles may meet in
/// an edge. Outward faces; vertices in metres, the first voxel of the grid at the origin.
catalog::TriangleMesh level_surface(const std::vector<float>& field, const VoxelGrid& grid);

}  // namespace shape_pipeline
