// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"
#include "dem_gpu/meshes/box_tree.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// Convex piece of the layer behind a face, in which depth is measured from that face's plane.
struct MeshCell {
  std::vector<HalfSpace> planes;  // inside all; the face's own first
  Box box;
};

/// The layer behind a closed surface cut into one cell a face, at most `depth` deep: neighbours meet in the bisector of
/// their planes, faces on opposite sides of a thin solid or round a sharp edge in the bisector as well, so that depth
/// is that below the nearest plane. Behind coplanar faces of any cut the cells are the layer behind the plane. About
/// saddle vertices, and behind a re-entrant edge of many triangles, cells may overlap or leave a gap: the field is then
/// double or zero there, still one fixed field, so its force stays a gradient.
std::vector<MeshCell> mesh_cells(const catalog::TriangleMesh& surface, Real depth);

}  // namespace dem_gpu
