// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/flush_planes.h"
#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"
#include "dem_gpu/narrow_phase/surface_pieces.h"

namespace dem_gpu {

/// What of a surface and a solid meets: the surface's faces with a piece inside, and the solid's planes that cut them.
struct Meeting {
  /// So many times the rounding of positions a piece must reach below each plane that cuts it: of a thinner overlap
  /// some faces may be lost to rounding where others are not.
  static constexpr LocalReal kClearDepth = 100;

  FaceSet faces, planes;
  bool is_thin = false;
};

/// Pieces of a few faces, cut by one plane after the other. All of them by one plane before the next: the cuts of one
/// plane do not wait for one another, which those of one face do.
class CutPieces {
 public:
  TALUS_HD int count() const { return count_; }
  TALUS_HD Polygon& piece(int i) { return piece_[i]; }
  TALUS_HD int face(int i) const { return face_[i]; }

  /// False if there is no room.
  TALUS_HD TALUS_INLINE bool add(const Polygon& polygon, int face) {
    if (count_ == kMost) return false;
    face_[count_] = static_cast<std::uint8_t>(face);
    piece_[count_++] = polygon;
    return true;
  }

  /// Does any piece reach beyond the plane?
  TALUS_HD TALUS_INLINE bool reaches_beyond(const LocalHalfSpace& plane) const {
    LaneSet beyond = 0;
    for (int i = 0; i < count_; ++i) beyond |= lanes_above(Lanes{}, depths_below(plane, piece_[i].corners));
    return beyond != 0;
  }

  /// Does any piece reach deeper below the plane?
  TALUS_HD TALUS_INLINE bool reaches_below(const LocalHalfSpace& plane, LocalReal depth) const {
    const Lanes limit = every_lane<Lanes>(depth);
    LaneSet below = 0;
    for (int i = 0; i < count_; ++i) below |= lanes_above(depths_below(plane, piece_[i].corners), limit);
    return below != 0;
  }

  /// Keeps what lies inside the plane. A piece that outgrows its lanes becomes two; false if there is no room for them.
  TALUS_HD TALUS_INLINE bool cut_all(const LocalHalfSpace& plane) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      Polygon polygon = piece_[i];
      const std::uint8_t face = face_[i];
      Lanes depths = depths_below(plane, polygon.corners);
      if (outgrows(cut_order(polygon, depths))) {
        if (!add(half_of(polygon, true), face)) return false;
        polygon = half_of(polygon, false);
        depths = depths_below(plane, polygon.corners);
      }
      piece_[kept] = cut(polygon, depths, cut_order(polygon, depths));
      face_[kept] = face;
      kept += static_cast<int>(piece_[kept].count > 0);
    }
    count_ = kept;
    return true;
  }

 private:
  static constexpr int kMost = 24;
  ScratchArray<Polygon, kMost> piece_;
  ScratchArray<std::uint8_t, kMost> face_;
  int count_ = 0;
};

/// The faces of a surface that are not wholly in front of a plane, kLanes of them at most from `first` on.
struct FacesToCut {
  std::uint8_t face[kLanes];
  int count = 0;
};

TALUS_HD TALUS_INLINE FacesToCut faces_to_cut(const PartView& surface, int first, const FaceSet& wanted,
                                              const PlaneSides& sides) {
  const int last = first + kLanes < surface.range.face_count ? first + kLanes : surface.range.face_count;
  FacesToCut faces;
  for (int f = first; f < last; ++f) {
    LaneSet outside = 0;
    for (int k = 0; k < sides.plane_count; k += kLanes)
      outside |= sets_holding_all(sides.outside.data() + k, surface.faces[f].vertices);
    faces.face[faces.count] = static_cast<std::uint8_t>(f);
    faces.count += static_cast<int>(outside == 0) & static_cast<int>(wanted.has(f));
  }
  return faces;
}

/// Each polygon of a face has two corners of the diagonals and kLanes - 2 of its own.
inline constexpr int kMaxFacePieces = (kMaxFaceCorners - 2 + kLanes - 3) / (kLanes - 2);

/// The polygons of some faces, by their numbers.
struct PolygonsToCut {
  static constexpr int kMost = kLanes * kMaxFacePieces;
  std::uint8_t face[kMost];
  int piece[kMost];  // in PartView::face_pieces
  int count = 0;

  TALUS_HD PolygonsToCut(const PartView& surface, const FacesToCut& faces) {
    for (int i = 0; i < faces.count; ++i) {
      const FaceCorners& corners = surface.faces[faces.face[i]];
      for (int p = corners.first_piece; p < corners.first_piece + corners.piece_count; ++p) {
        face[count] = faces.face[i];
        piece[count++] = p;
      }
    }
  }
};

/// Keeps of the pieces what lies inside the solid; false if there is no room.
TALUS_HD TALUS_INLINE bool cut_to_solid(const PartView& solid, const PlaneSides& sides, LocalReal tolerance,
                                        CutPieces& pieces, Meeting& meeting) {
  FaceSet cutting;
  for (int k = 0; k < sides.plane_count && pieces.count() > 0; ++k) {
    const int f = sides.plane[k];
    if (!pieces.reaches_beyond(solid.planes[f])) continue;
    if (!pieces.cut_all(solid.planes[f])) return false;
    cutting.add(f);
  }
  meeting.planes.add(cutting);
  for (int k = 0; k < sides.plane_count && pieces.count() > 0; ++k)
    if (const int f = sides.plane[k]; cutting.has(f))
      meeting.is_thin |= !pieces.reaches_below(solid.planes[f], Meeting::kClearDepth * tolerance);
  return true;
}

/// Visits each piece of `surface`'s faces that lies inside `solid`, both convex. `vertices` are the surface's, already
/// in the solid's frame, with their outcodes against the solid's planes, which are rounded to `tolerance` [m] at most.
/// Only `wanted` faces; each clipped face is an independent polygon, no topology is built. visitor(polygon in the
/// solid's frame, face index). Returns false if a polygon was truncated.
template <class Visitor>
TALUS_HD TALUS_DEVICE_CALL bool visit_surface_inside(const PartView& surface, const FaceSet& wanted,
                                                     const PartView& solid, const PartVertices& vertices,
                                                     const PlaneSides& sides, LocalReal tolerance, Meeting& meeting,
                                                     Visitor&& visitor) {
  bool is_whole = true;
  meeting = {};
  for (int first = 0; first < surface.range.face_count; first += kLanes) {
    const PolygonsToCut polygons(surface, faces_to_cut(surface, first, wanted, sides));
    // All of them together; one at a time if they become more pieces than there is room for.
    int together = polygons.count;
    for (int begin = 0; begin < polygons.count;) {
      CutPieces pieces;
      bool fits = true;
      for (int i = begin; i < begin + together && fits; ++i) {
        const FacePiece& piece = surface.face_pieces[polygons.piece[i]];
        fits = pieces.add({vertices.at(piece.corner), piece.count}, polygons.face[i]);
      }
      fits = fits && cut_to_solid(solid, sides, tolerance, pieces, meeting);
      if (!fits && together > 1) {
        together = 1;
        continue;
      }
      is_whole &= fits;
      for (int i = 0; i < pieces.count(); ++i) {
        meeting.faces.add(pieces.face(i));
        visitor(pieces.piece(i), pieces.face(i));
      }
      begin += together;
    }
  }
  return is_whole;
}

/// The same where faces of the surface are flush with planes of the solid: after all others each of them by itself.
/// `side.surface` and `side.solid` are the parts.
template <class Visitor>
TALUS_HD TALUS_DEVICE_CALL bool visit_flush_surface_inside(const FlushSide& side, const FaceSet& wanted,
                                                           const PartVertices& vertices, const PlaneSides& sides,
                                                           LocalReal tolerance, Meeting& meeting, Visitor&& visitor) {
  const FaceSet flush = side.planes.count > 0 ? side.faces() : FaceSet{};
  const int last = side.planes.count > 0 ? side.surface.range.face_count : 0;
  FlushSolid seen;
  PartView solid = side.solid;
  const PlaneSides* seen_sides = &sides;
  FaceSet visited = wanted.without(flush);
  bool is_whole = true;
  for (int f = 0;; ++f) {
    is_whole &= visit_surface_inside(side.surface, visited, solid, vertices, *seen_sides, tolerance, meeting, visitor);
    while (f < last && !(flush.has(f) && seen.set(side, f, vertices, sides))) ++f;
    if (f >= last) return is_whole;
    visited = {};
    visited.add(f);
    solid.planes = seen.planes.data();
    seen_sides = &seen.sides;
  }
}

/// Of the planes of a part's faces those that have any of some faces.
TALUS_HD inline FaceSet planes_of(const PartView& part, const FaceSet& faces) {
  FaceSet planes;
  for (int f = 0; f < part.range.face_count; ++f)
    if (faces.has(f)) planes.add(part.faces[f].plane);
  return planes;
}

/// The faces of a solid that bound its overlap with a surface of which all that is inside it has been visited: those
/// whose planes cut that, and those with a corner inside the surface's own body. The other way round, only planes of
/// the surface's faces that lie inside bound it, so that no other one need cut the solid's: `sides` loses those. (What
/// lies in the solid and behind the surface's planes that bound the overlap is the overlap.) Where rounding could have
/// lost some, all bound.
TALUS_HD TALUS_DEVICE_CALL inline FaceSet faces_that_bound(const PartView& solid, const PartView& surface,
                                                           const Meeting& met, const PartVertices& vertices,
                                                           PlaneSides& sides) {
  std::uint64_t outside = 0;
  for (int k = 0; k < sides.plane_count; ++k) outside |= sides.outside[k];
  const std::uint64_t inside = ~outside & vertices.all();
  const bool is_lost = met.faces.is_empty() && inside != 0 && inside != vertices.all();
  if (met.is_thin || is_lost) return FaceSet::all();
  const FaceSet cut_by = planes_of(surface, met.faces);
  int kept = 0;
  for (int k = 0; k < sides.plane_count; ++k) {
    sides.outside[kept] = sides.outside[k];
    sides.plane[kept] = sides.plane[k];
    kept += static_cast<int>(cut_by.has(surface.faces[sides.plane[k]].plane));
  }
  sides.plane_count = kept;
  sides.fill_up();
  FaceSet cutting;
  if (!met.faces.is_empty()) cutting = planes_of(solid, met.planes);
  FaceSet bounding;
  for (int f = 0; f < solid.range.face_count; ++f)
    if ((solid.faces[f].vertices & inside) != 0 || cutting.has(solid.faces[f].plane)) bounding.add(f);
  return bounding;
}

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

/// Sums `Integrals` over the overlap of part a of one body and part b of another. `b_to_a` and `a_to_b` are inverse
/// frame changes; `rule` of the two bodies; `separating` is the pair's cache. `distance`: of separated parts, that they
/// are apart at least, in a's unscaled frame [m]; 0 where that is not known. `Integrals` provides:
///   kNeedsDepthPlanes                           whether depth fields are integrated; then also
///   is_truncated                                whether a piece of a polygon did not fit
///   finish()                                    without depth fields: ends the pair
///   add_surface_b(polygon, plane_b, is_outer, part_a, b_to_a)   a piece of b's surface inside a, polygon in a's frame
///   add_surface_a(polygon, plane_a, is_outer, part_b, b_to_a)   a piece of a's surface inside b, polygon in b's frame
/// Cut faces are visited too.
template <class Integrals>
TALUS_HD OverlapStatus integrate_overlap(const PartView& a, const PartView& b, const FrameChange& b_to_a,
                                         const FrameChange& a_to_b, const FlushRule& rule, SeparatingPlane& separating,
                                         Integrals& integrals, Real& distance) {
  distance = 0;
  if (separating != 0) {
    distance = separating > 0 ? distance_outside(b, a.planes[separating - 1], b_to_a)
                              : b_to_a.scale * distance_outside(a, b.planes[-separating - 1], a_to_b);
    if (distance >= 0) return OverlapStatus::separated;
  }
  separating = 0;

  PartVertices vertices_b, vertices_a;
  PlaneSides sides_b, sides_a;
  const LocalReal tolerance_a = rounded(kCoplanarity * (a.range.radius + b_to_a.scale * b.range.radius));
  const LocalReal tolerance_b = rounded(kCoplanarity * (b.range.radius + a_to_b.scale * a.range.radius));
  // Of the smaller part only: a large one's vertices are far from a plane that is nearly flush.
  const bool is_b_smaller = b_to_a.scale * b.range.radius <= a.range.radius;
  const LocalReal near_a = is_b_smaller ? tolerance_a + rounded(kNearlyFlush * b_to_a.scale * b.range.radius) : 0;
  const LocalReal near_b = is_b_smaller ? 0 : tolerance_b + rounded(kNearlyFlush * a_to_b.scale * a.range.radius);
  transform_vertices(b, b_to_a, vertices_b);
  const int face_a = classify(a, vertices_b, near_a, sides_b);
  if (face_a >= 0) {
    separating = static_cast<SeparatingPlane>(face_a + 1);
    return OverlapStatus::separated;
  }
  transform_vertices(a, a_to_b, vertices_a);
  const int face_b = classify(b, vertices_a, near_b, sides_a);
  if (face_b >= 0) {
    separating = static_cast<SeparatingPlane>(-face_b - 1);
    return OverlapStatus::separated;
  }

  FlushPlanes flush;
  if (sides_a.near_count + sides_b.near_count > 0)
    flush.find(a, b, b_to_a, rule, is_b_smaller, is_b_smaller ? sides_b : sides_a,
               is_b_smaller ? vertices_b : vertices_a, is_b_smaller ? near_a : near_b);
  const auto add = [&](auto&& visit, const PartView& solid, const PartVertices& vertices, auto&& add_piece) {
    if constexpr (Integrals::kNeedsDepthPlanes)
      return integrate_near_depth(solid, vertices, visit, add_piece);
    else
      return visit([&](Polygon& polygon, int face) { add_piece(polygon, face, solid); });
  };
  const auto add_b = [&](const FaceSet& wanted, Meeting& meeting) {
    const auto visit = [&](auto&& visitor) {
      return visit_flush_surface_inside({flush, b, a, b_to_a, false}, wanted, vertices_b, sides_b, tolerance_a, meeting,
                                        visitor);
    };
    return add(visit, a, vertices_b, [&](Polygon& polygon, int face, const PartView& solid) {
      integrals.add_surface_b(polygon, b.planes[face], face < b.range.outer_face_count, solid, b_to_a);
    });
  };
  const auto add_a = [&](const FaceSet& wanted, Meeting& meeting) {
    const auto visit = [&](auto&& visitor) {
      return visit_flush_surface_inside({flush, a, b, b_to_a, true}, wanted, vertices_a, sides_a, tolerance_b, meeting,
                                        visitor);
    };
    return add(visit, b, vertices_a, [&](Polygon& polygon, int face, const PartView& solid) {
      integrals.add_surface_a(polygon, a.planes[face], face < a.range.outer_face_count, solid, b_to_a);
    });
  };
  // The body that reaches in with fewer of its vertices comes first: few of its faces lie inside, and they tell which
  // of the other's are worth a look. Where faces lie flush all are looked at.
  const bool is_flush = flush.count > 0;
  Meeting meeting;
  bool is_whole;
  if (sides_b.least_inside(vertices_b) <= sides_a.least_inside(vertices_a)) {
    is_whole = add_b(FaceSet::all(), meeting);
    is_whole &= add_a(is_flush ? FaceSet::all() : faces_that_bound(a, b, meeting, vertices_a, sides_a), meeting);
  } else {
    is_whole = add_a(FaceSet::all(), meeting);
    is_whole &= add_b(is_flush ? FaceSet::all() : faces_that_bound(b, a, meeting, vertices_b, sides_b), meeting);
  }
  if constexpr (Integrals::kNeedsDepthPlanes)
    is_whole &= !integrals.is_truncated;
  else
    integrals.finish();
  return is_whole ? OverlapStatus::overlapping : OverlapStatus::polygon_truncated;
}

}  // namespace dem_gpu
