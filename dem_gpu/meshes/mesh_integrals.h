// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/narrow_phase/placed_part.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {

/// Adds what lies in one facet's cell: depth below the facet's plane over the part's surface there, in the mesh's axes.
/// `origin`: the body's centre in the mesh's frame. Cells of neighbouring facets fit, so the sum over coplanar facets
/// is that of their plane. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_part_in_cell(const PlacedPart& body, const MeshView& mesh, const MeshFacet& facet,
                                     const Vec3& origin, Integrals& integrals) {
  ScratchArray<LocalHalfSpace, kMaxCellPlanes> planes;
  for (int p = 0; p < facet.plane_count; ++p) {
    const HalfSpace plane = mesh.planes[facet.first_plane + p];
    planes[p] = rounded(HalfSpace{plane.normal, depth_below(plane, origin)});
  }
  return visit_part_inside(body, planes.data(), facet.plane_count, [&](const Polygon& polygon, int face) {
    integrals.add_polygon(polygon, planes[0], body.face_normal(face), face < body.part.range.outer_face_count);
  });
}

}  // namespace dem_gpu
