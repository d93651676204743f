// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/part_overlap.h"

namespace dem_gpu {

/// A convex part of a body in a wall's axes, about the body's centre.
struct PlacedPart {
  const PartView& part;
  FrameChange change;  // from the unscaled body frame
  PartVertices vertices;
  Vec3 centre;  // of the bounding ball [m]
  Real radius;  // [m]

  TALUS_HD PlacedPart(const PartView& view, const FrameChange& to_wall)
      : part(view),
        change(to_wall),
        centre(to_wall.point(view.range.centre)),
        radius(to_wall.scale * view.range.radius) {
    transform_vertices(view, to_wall, vertices);
  }

  TALUS_HD Vec3 face_normal(int face) const { return change.direction(part.planes[face].normal); }
};

/// visitor(polygon, face) for each piece of the part's surface inside all of `planes`. A face in one of the planes
/// counts where the part lies on the inner side, so once for two solids that share the plane. False if a polygon was
/// truncated.
template <class Visitor>
TALUS_HD bool visit_part_inside(const PlacedPart& body, const LocalHalfSpace* planes, int plane_count,
                                Visitor&& visitor) {
  for (int p = 0; p < plane_count; ++p)
    if (-depth_below<Real>(planes[p], body.centre) >= body.radius) return true;
  PartRange range;
  range.face_count = plane_count;
  const PartView solid{range, nullptr, planes, nullptr, nullptr, nullptr, nullptr, {}};
  PlaneSides sides;
  const LocalReal tolerance = rounded(kCoplanarity * body.radius);
  if (classify(solid, body.vertices, tolerance, sides) >= 0) return true;
  Meeting meeting;
  return visit_surface_inside(body.part, FaceSet::all(), solid, body.vertices, sides, {sides, tolerance, true}, meeting,
                              visitor);
}

}  // namespace dem_gpu
