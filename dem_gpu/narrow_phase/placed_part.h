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

/// Faces of a body in planes that bound a solid, to rounding. Where the body lies on the inner side they count, whole,
/// so that of two solids that share the plane they count for one.
struct FacesInPlanes {
  const PlacedPart& body;
  const LocalHalfSpace* planes;
  const PlaneSides& sides;
  LocalReal tolerance;  // [m]

  TALUS_HD bool lie_in(std::uint64_t vertices, int plane) const {
    return (vertices & ~vertices_near(planes[plane], body.vertices, tolerance)) == 0;
  }
  TALUS_HD FaceSet faces() const {
    FaceSet flush;
    for (int f = 0; f < body.part.range.face_count; ++f)
      for (int k = 0; k < sides.near_count; ++k)
        if (lie_in(body.part.faces[f].vertices, sides.near[k])) flush.add(f);
    return flush;
  }

  /// What cuts one of these faces: all but the planes that it lies in. False if it does not count.
  TALUS_HD bool set_sides(int face, PlaneSides& of_face) const {
    const LocalVec3 normal = rounded(body.face_normal(face));
    FaceSet own;
    for (int k = 0; k < sides.near_count; ++k) {
      if (!lie_in(body.part.faces[face].vertices, sides.near[k])) continue;
      if (dot(planes[sides.near[k]].normal, normal) < 0) return false;
      own.add(sides.near[k]);
    }
    of_face.plane_count = 0;
    for (int k = 0; k < sides.plane_count; ++k) {
      if (own.has(sides.plane[k])) continue;
      of_face.outside[of_face.plane_count] = sides.outside[k];
      of_face.plane[of_face.plane_count++] = sides.plane[k];
    }
    of_face.fill_up();
    return true;
  }
};

/// visitor(polygon, face) for each piece of the part's surface inside all of `planes`. False if a polygon was
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
  const FacesInPlanes in_planes{body, planes, sides, tolerance};
  const FaceSet flush = in_planes.faces();
  const int last = flush.is_empty() ? 0 : body.part.range.face_count;
  PlaneSides of_face;
  const PlaneSides* cutting = &sides;
  FaceSet visited = FaceSet::all().without(flush);
  Meeting meeting;
  bool is_whole = true;
  for (int f = 0;; ++f) {
    is_whole &= visit_surface_inside(body.part, visited, solid, body.vertices, *cutting, tolerance, meeting, visitor);
    while (f < last && !(flush.has(f) && in_planes.set_sides(f, of_face))) ++f;
    if (f >= last) return is_whole;
    visited = {};
    visited.add(f);
    cutting = &of_face;
  }
}

}  // namespace dem_gpu
