// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/closing_planes.h"
#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/part_pair.h"
#include "dem_gpu/narrow_phase/surface_pieces.h"
#include "dem_gpu/narrow_phase/surface_triangles.h"

namespace dem_gpu {

/// A depth field of so few planes is taken as it is: to look for what matters of it costs more.
inline constexpr int kFewPlanes = 12;

/// Hands the pieces of a surface inside a solid, which `visit` visits, to add(polygon, face, solid), the solid with
/// what of its depth field matters on them. `vertices`: the surface's, in the solid's frame. False if a polygon was
/// truncated.
template <class Visit, class Add>
TALUS_HD TALUS_DEVICE_CALL bool integrate_near_depth(const PartView& solid, const PartVertices& vertices,
                                                     const Visit& visit, Add&& add) {
  if (solid.depth.term_count == 0 && solid.depth.plane_count <= kFewPlanes)
    return visit([&](Polygon& piece, int face) { add(piece, face, solid); });
  SurfacePieces pieces;
  if (!visit([&](const Polygon& piece, int face) { pieces.add(piece, face); })) return false;
  if (pieces.count() == 0) return true;
  NearField near;
  PartView near_solid = solid;
  if (!pieces.is_complete()) {
    near_solid.depth = near_field(solid.depth, vertices, ball_about(vertices), near);
    return visit([&](Polygon& piece, int face) { add(piece, face, near_solid); });
  }
  near_solid.depth = near_field(solid.depth, pieces, ball_about(pieces), near);
  pieces.visit([&](Polygon& piece, int face) { add(piece, face, near_solid); });
  return true;
}

enum class OverlapStatus : std::uint8_t { separated, overlapping, polygon_truncated };

/// The overlap of two parts by the depth of each one's surface in the other. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_depths(PartPair& pair, Integrals& integrals) {
  const auto add = [&](bool is_of_b, const FaceSet& wanted, Meeting& meeting) {
    const PartView& surface = pair.surface(is_of_b);
    return integrate_near_depth(
        pair.solid(is_of_b), pair.vertices(is_of_b),
        [&](auto&& visitor) { return pair.visit(is_of_b, wanted, meeting, visitor); },
        [&](Polygon& polygon, int face, const PartView& solid) {
          const bool is_outer = face < surface.range.outer_face_count;
          if (is_of_b)
            integrals.add_surface_b(polygon, surface.planes[face], is_outer, solid, pair.b_to_a);
          else
            integrals.add_surface_a(polygon, surface.planes[face], is_outer, solid, pair.b_to_a);
        });
  };
  const bool is_b_first = pair.is_b_first();
  Meeting meeting, unused;
  bool is_whole = add(is_b_first, FaceSet::all(), meeting);
  is_whole &= add(!is_b_first, pair.bounding(!is_b_first, meeting), unused);
  return is_whole && !integrals.is_truncated;
}

/// The overlap of two parts as a solid: from one part's surface alone where that can be, as most often, else from
/// both. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_solid(PartPair& pair, Integrals& integrals) {
  SurfaceTriangles triangles;
  bool is_all_here = true;  // in `triangles`; else some have been added
  const auto to_frame_of_a = [&](bool is_of_b) {
    triangles.fill_up();
    if (!is_of_b) triangles.move(pair.b_to_a);
  };
  const auto hand_on = [&](bool is_of_b) {
    if (triangles.is_empty()) return;
    to_frame_of_a(is_of_b);
    integrals.add_surface(triangles, is_of_b);
    triangles.clear();
  };
  const auto collect = [&](bool is_of_b, const FaceSet& wanted, Meeting& meeting) {
    const int outer_count = pair.surface(is_of_b).range.outer_face_count;
    return pair.visit(is_of_b, wanted, meeting, [&](const Polygon& polygon, int face) {
      if (triangles.add(polygon, face < outer_count)) return;
      is_all_here = false;
      hand_on(is_of_b);
      triangles.add(polygon, face < outer_count);
    });
  };
  const bool is_b_first = pair.is_b_first();
  Meeting meeting, unused;
  bool is_whole = collect(is_b_first, FaceSet::all(), meeting);
  ClosingPlanes planes;
  if (is_whole && is_all_here && !triangles.is_empty() && !meeting.is_thin && !pair.is_flush() &&
      planes.find(pair.solid(is_b_first), pair.closing(!is_b_first, meeting), triangles.point(0))) {
    to_frame_of_a(is_b_first);
    if (!is_b_first) planes = planes.moved(pair.b_to_a);
    if (integrals.add_closed(triangles, is_b_first, planes)) return true;
    integrals.add_surface(triangles, is_b_first);
    triangles.clear();
  }
  hand_on(is_b_first);
  is_whole &= collect(!is_b_first, pair.bounding(!is_b_first, meeting), unused);
  hand_on(!is_b_first);
  return is_whole;
}

/// Sums `Integrals` over the overlap of part a of one body and part b of another; `separating` is the pair's cache.
/// `distance`: of separated parts, that they
/// are apart at least, in a's unscaled frame [m]; 0 where that is not known. `Integrals` provides, where kNeedsDepth
/// says that depth fields are integrated:
///   is_truncated                                whether a piece of a polygon did not fit
///   add_surface_b(polygon, plane_b, is_outer, part_a, b_to_a)   a piece of b's surface inside a, polygon in a's frame
///   add_surface_a(polygon, plane_a, is_outer, part_b, b_to_a)   a piece of a's surface inside b, polygon in b's frame
/// else, all in a's frame:
///   add_surface(triangles, is_of_b)             one part's surface inside the other; both parts' are added
///   add_closed(triangles, is_of_b, planes)      one part's surface inside the other, whose planes close it; false, and
///                                               nothing is added, where rounding asks for both
/// Cut faces are visited too.
template <class Integrals>
TALUS_HD OverlapStatus integrate_overlap(const PartView& a, const PartView& b, const BodyFrames& bodies,
                                         SeparatingPlane& separating, Integrals& integrals, Real& distance) {
  distance = 0;
  if (separating != 0) {
    distance = separating > 0 ? distance_outside(b, a.planes[separating - 1], bodies.b_to_a)
                              : distance_outside(a, moved(bodies.b_to_a, b.planes[-separating - 1]));
    if (distance >= 0) return OverlapStatus::separated;
    distance = 0;
  }
  PartPair pair(a, b, bodies.b_to_a);
  separating = pair.classify_both(bodies);
  if (separating != 0) return OverlapStatus::separated;
  bool is_whole;
  if constexpr (Integrals::kNeedsDepth)
    is_whole = integrate_depths(pair, integrals);
  else
    is_whole = integrate_solid(pair, integrals);
  return is_whole ? OverlapStatus::overlapping : OverlapStatus::polygon_truncated;
}

}  // namespace dem_gpu
