// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/narrow_phase/depth_integrals.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {

/// A convex part of a body in the mesh's axes, about the body's centre.
struct PartInMesh {
  const PartView& part;
  FrameChange change;  // from the unscaled body frame
  PartVertices vertices;
  Vec3 centre;  // of the bounding ball [m]
  Real radius;  // [m]

  TALUS_HD PartInMesh(const PartView& view, const FrameChange& to_mesh)
      : part(view),
        change(to_mesh),
        centre(to_mesh.point(view.range.centre)),
        radius(to_mesh.scale * view.range.radius) {
    transform_vertices(view, to_mesh, vertices);
  }
};

/// Adds what lies in one facet's cell: depth below the facet's plane over the part's surface there. `origin`: the
/// body's centre in the mesh's frame. Cells of neighbouring facets fit, so the sum over coplanar facets is that of
/// their plane. False if a polygon was truncated.
TALUS_HD inline bool integrate_part_in_cell(const PartInMesh& body, const MeshView& mesh, const MeshFacet& facet,
                                            const Vec3& origin, WallIntegrals& integrals) {
  ScratchArray<HalfSpace, kMaxCellPlanes> planes;
  for (int p = 0; p < facet.plane_count; ++p) {
    const HalfSpace plane = mesh.planes[facet.first_plane + p];
    planes[p] = {plane.normal, depth_below(plane, origin)};
    if (-depth_below(planes[p], body.centre) >= body.radius) return true;
  }
  PartRange range;
  range.face_count = facet.plane_count;  // all inner: a face in a plane between two cells counts in the one it bounds
  const PartView cell{range, nullptr, planes.data(), nullptr, nullptr, nullptr, 0};
  PlaneSides sides;
  const Real tolerance = kCoplanarity * body.radius;
  if (classify(cell, body.vertices, tolerance, sides) >= 0) return true;
  return visit_surface_inside(body.part, body.part.range.face_count, cell, body.vertices, sides,
                              {sides, tolerance, true}, [&](const Polygon& polygon, int face) {
                                const Vec3 normal = body.change.direction(body.part.planes[face].normal);
                                PolygonDepth sum;
                                add_linear_depth(polygon, planes[0], normal, sum);
                                integrals.add_polygon(sum, normal, face < body.part.range.outer_face_count);
                              });
}

}  // namespace dem_gpu
