// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"
#include "dem_gpu/narrow_phase/surface_pieces.h"

namespace dem_gpu {

/// Which faces count that lie in a face plane of the other part. Opposed normals: none, the parts only touch there.
/// Equal normals: one of the two, the outer one rather than the inner one, else that of the open part; so coincident
/// faces count once, and a face in another body's cut plane as if there were no cut.
struct CoplanarRule {
  const PlaneSides& sides;
  LocalReal tolerance;  // [m]
  bool is_closed;       // the solid is the closed one of the two

  TALUS_HD bool keeps(const Polygon& face, bool is_inner_face, const PartView& solid) const {
    for (int k = 0; k < sides.coplanar_count; ++k) {
      const int f = sides.coplanar[k];
      const LocalHalfSpace plane = solid.planes[f];
      bool lies_in_plane = true;
      for (int c = 0; c < face.count && lies_in_plane; ++c)
        lies_in_plane = std::abs(dot(plane.normal, face.corner[c]) - plane.offset) <= tolerance;
      if (!lies_in_plane) continue;
      const LocalVec3 area = cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
      if (dot(plane.normal, area) < 0) return false;
      const bool is_inner_plane = f >= solid.range.outer_face_count;
      return is_inner_face == is_inner_plane ? is_closed : is_inner_plane;
    }
    return true;
  }
};

/// Visits each piece of `surface`'s faces that lies inside `solid`, both convex. `vertices` are the surface's, already
/// in the solid's frame, with their outcodes against the solid's planes. Each clipped face is an independent polygon;
/// no topology is built. visitor(polygon in the solid's frame, face index). Returns false if a polygon was truncated.
template <class Visitor>
TALUS_HD bool visit_surface_inside(const PartView& surface, int face_count, const PartView& solid,
                                   const PartVertices& vertices, const PlaneSides& sides, const CoplanarRule& coplanar,
                                   Visitor&& visitor) {
  Polygon buffer[2];
  ScratchArray<std::uint8_t, kMaxPartFaces> cutting;
  for (int f = 0; f < face_count; ++f) {
    const FaceCorners face = surface.faces[f];
    bool is_outside = false;
    int cutting_count = 0;
    for (int k = 0; k < sides.plane_count && !is_outside; ++k) {
      const std::uint64_t in_front = sides.outside[k] & face.vertices;
      is_outside = in_front == face.vertices;
      if (in_front != 0) cutting[cutting_count++] = sides.plane[k];
    }
    if (is_outside) continue;
    Polygon* polygon = &buffer[0];
    Polygon* other = &buffer[1];
    polygon->count = face.count;
    polygon->is_truncated = false;
    const std::uint8_t* corner = surface.corners + face.first;
    for (int c = 0; c < face.count; ++c) polygon->corner[c] = vertices[corner[c]];
    if (sides.coplanar_count > 0 && !coplanar.keeps(*polygon, f >= surface.range.outer_face_count, solid)) continue;
    for (int k = 0; k < cutting_count && polygon->count > 0; ++k) {
      clip(*polygon, solid.planes[cutting[k]], *other);
      Polygon* swap = polygon;
      polygon = other;
      other = swap;
    }
    if (polygon->is_truncated) return false;
    if (polygon->count > 0) visitor(*polygon, f);
  }
  return true;
}

/// Hands the pieces of a surface inside a solid, which `visit` visits, to add(polygon, face, solid), the solid with
/// what of its depth field matters on them. `vertices`: the surface's, in the solid's frame. False if a polygon was
/// truncated.
template <class Visit, class Add>
TALUS_HD bool integrate_near_depth(const PartView& solid, const PartVertices& vertices, const Visit& visit, Add&& add) {
  SurfacePieces pieces;
  if (!visit([&](const Polygon& piece, int face) { pieces.add(piece, face); })) return false;
  if (pieces.count() == 0) return true;
  NearField near;
  PartView near_solid = solid;
  if (!pieces.is_complete()) {
    near_solid.depth = near_field(solid.depth, vertices, ball_about(vertices), near);
    return visit([&](Polygon& piece, int face) { add(piece, face, near_solid); });
  }
  pieces.corners.pad();
  near_solid.depth = near_field(solid.depth, pieces.corners, ball_about(pieces.corners), near);
  pieces.visit([&](Polygon& piece, int face) { add(piece, face, near_solid); });
  return true;
}

enum class OverlapStatus : std::uint8_t { separated, overlapping, polygon_truncated };

/// Sums `Integrals` over the overlap of part a of one body and part b of another. `b_to_a` and `a_to_b` are inverse
/// frame changes; `separating` is the pair's cache. `Integrals` provides:
///   kNeedsDepthPlanes                           whether depth fields are integrated; then also
///   is_truncated                                whether a piece of a polygon did not fit
///   kNeedsInnerFaces                            whether cut faces are visited too
///   add_surface_b(polygon, plane_b, is_outer, part_a, b_to_a)   a piece of b's surface inside a, polygon in a's frame
///   add_surface_a(polygon, plane_a, is_outer, part_b, b_to_a)   a piece of a's surface inside b, polygon in b's frame
template <class Integrals>
TALUS_HD OverlapStatus integrate_overlap(const PartView& a, const PartView& b, const FrameChange& b_to_a,
                                         const FrameChange& a_to_b, SeparatingPlane& separating, Integrals& integrals) {
  if (separating > 0 && lies_outside(b, a.planes[separating - 1], b_to_a)) return OverlapStatus::separated;
  if (separating < 0 && lies_outside(a, b.planes[-separating - 1], a_to_b)) return OverlapStatus::separated;
  separating = 0;

  PartVertices vertices_b, vertices_a;
  PlaneSides sides_b, sides_a;
  const LocalReal tolerance_a = rounded(kCoplanarity * (a.range.radius + b_to_a.scale * b.range.radius));
  const LocalReal tolerance_b = rounded(kCoplanarity * (b.range.radius + a_to_b.scale * a.range.radius));
  transform_vertices(b, b_to_a, vertices_b);
  const int face_a = classify(a, vertices_b, tolerance_a, sides_b);
  if (face_a >= 0) {
    separating = static_cast<SeparatingPlane>(face_a + 1);
    return OverlapStatus::separated;
  }
  transform_vertices(a, a_to_b, vertices_a);
  const int face_b = classify(b, vertices_a, tolerance_b, sides_a);
  if (face_b >= 0) {
    separating = static_cast<SeparatingPlane>(-face_b - 1);
    return OverlapStatus::separated;
  }

  const int faces_b = Integrals::kNeedsInnerFaces ? b.range.face_count : b.range.outer_face_count;
  const int faces_a = Integrals::kNeedsInnerFaces ? a.range.face_count : a.range.outer_face_count;
  const auto visit_b = [&](auto&& visitor) {
    return visit_surface_inside(b, faces_b, a, vertices_b, sides_b, {sides_b, tolerance_a, true}, visitor);
  };
  const auto visit_a = [&](auto&& visitor) {
    return visit_surface_inside(a, faces_a, b, vertices_a, sides_a, {sides_a, tolerance_b, false}, visitor);
  };
  const auto add_b = [&](Polygon& polygon, int face, const PartView& solid) {
    integrals.add_surface_b(polygon, b.planes[face], face < b.range.outer_face_count, solid, b_to_a);
  };
  const auto add_a = [&](Polygon& polygon, int face, const PartView& solid) {
    integrals.add_surface_a(polygon, a.planes[face], face < a.range.outer_face_count, solid, b_to_a);
  };
  bool b_whole, a_whole;
  if constexpr (Integrals::kNeedsDepthPlanes) {
    b_whole = integrate_near_depth(a, vertices_b, visit_b, add_b);
    a_whole = integrate_near_depth(b, vertices_a, visit_a, add_a);
  } else {
    b_whole = visit_b([&](Polygon& polygon, int face) { add_b(polygon, face, a); });
    a_whole = visit_a([&](Polygon& polygon, int face) { add_a(polygon, face, b); });
  }
  if constexpr (Integrals::kNeedsDepthPlanes)
    if (integrals.is_truncated) return OverlapStatus::polygon_truncated;
  return a_whole && b_whole ? OverlapStatus::overlapping : OverlapStatus::polygon_truncated;
}

}  // namespace dem_gpu
