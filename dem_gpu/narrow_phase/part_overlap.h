// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/closing_planes.h"
#include "dem_gpu/narrow_phase/flush_planes.h"
#include "dem_gpu/narrow_phase/near_depth.h"
#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"
#include "dem_gpu/narrow_phase/surface_pieces.h"
#include "dem_gpu/narrow_phase/surface_triangles.h"

namespace dem_gpu {

/// What of a surface and a solid meets: the surface's faces with a piece inside, and the solid's planes that cut them.
struct Meeting {
  /// So many times the rounding of positions a piece must reach below each plane that cuts it: of a thinner overlap
  /// some faces may be lost to rounding where others are not.
  static constexpr LocalReal kClearDepth = 100;

  FaceSet faces, planes;
  FaceSet reached;  // of the planes, those that a piece still reaches
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

  /// Do the pieces have corners within some depth below the plane, and beneath it?
  struct Reach {
    bool is_near, is_deep;
  };
  TALUS_HD TALUS_INLINE Reach reach_below(const LocalHalfSpace& plane, LocalReal depth) const {
    const Lanes limit = every_lane<Lanes>(depth);
    constexpr LaneSet kAll = (1u << kLanes) - 1;
    LaneSet below = 0, all_below = kAll;
    for (int i = 0; i < count_; ++i) {
      const LaneSet of_piece = lanes_above(depths_below(plane, piece_[i].corners), limit);
      below |= of_piece;
      all_below &= of_piece;
    }
    return {all_below != kAll, below != 0};
  }

  /// What a plane has done.
  enum class Cut : std::uint8_t { none, some, no_room };

  /// Keeps what lies inside the plane. A piece that outgrows its lanes becomes two, if there is room for them.
  TALUS_HD TALUS_INLINE Cut cut_all(const LocalHalfSpace& plane) {
    ScratchArray<Lanes, kMost> depths;
    LaneSet beyond = 0;
    for (int i = 0; i < count_; ++i) {
      depths[i] = depths_below(plane, piece_[i].corners);
      beyond |= lanes_above(Lanes{}, depths[i]);
    }
    if (beyond == 0) return Cut::none;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (outgrows(cut_order(piece_[i], depths[i]))) {
        if (!add(half_of(piece_[i], true), face_[i])) return Cut::no_room;
        depths[count_ - 1] = depths_below(plane, piece_[count_ - 1].corners);
        piece_[i] = half_of(piece_[i], false);
        depths[i] = depths_below(plane, piece_[i].corners);
      }
      piece_[kept] = cut(piece_[i], depths[i], cut_order(piece_[i], depths[i]));
      face_[kept] = face_[i];
      kept += static_cast<int>(piece_[kept].count > 0);
    }
    count_ = kept;
    return Cut::some;
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
    const CutPieces::Cut cut = pieces.cut_all(solid.planes[f]);
    if (cut == CutPieces::Cut::no_room) return false;
    if (cut == CutPieces::Cut::some) cutting.add(f);
  }
  meeting.planes.add(cutting);
  for (int k = 0; k < sides.plane_count && pieces.count() > 0; ++k)
    if (const int f = sides.plane[k]; cutting.has(f)) {
      const CutPieces::Reach reach = pieces.reach_below(solid.planes[f], Meeting::kClearDepth * tolerance);
      if (reach.is_near) meeting.reached.add(f);
      meeting.is_thin |= !reach.is_deep;
    }
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
  const std::uint64_t inside = sides.inside(vertices);
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

/// How two bodies stand to each other. What a pair that is apart has no use for is made when it is asked for.
struct BodyFrames {
  const Pose &a, &b;
  Real radius_a, radius_b;  // of the bodies at scale 1, about their centres [m]
  FrameChange b_to_a;

  TALUS_HD BodyFrames(const Pose& pose_a, const Pose& pose_b, Real of_a, Real of_b)
      : a(pose_a), b(pose_b), radius_a(of_a), radius_b(of_b), b_to_a(frame_change(pose_a, pose_b)) {}

  TALUS_HD FrameChange a_to_b() const { return frame_change(b, a); }
  TALUS_HD FlushRule flush_rule() const { return FlushRule::of(radius_a, b_to_a.scale * radius_b, b_to_a.translation); }
};

/// Two parts, one of each body, as a pair that may overlap: their vertices in each other's frames, by each other's
/// planes.
struct PartPair {
  const PartView &a, &b;
  const FrameChange& b_to_a;
  PartVertices vertices_a, vertices_b;  // in the other part's frame
  PlaneSides sides_a, sides_b;          // of these vertices
  LocalReal tolerance_a, tolerance_b;   // rounding of a's planes, and of b's [m]
  FlushPlanes flush;

  TALUS_HD PartPair(const PartView& part_a, const PartView& part_b, const FrameChange& change)
      : a(part_a), b(part_b), b_to_a(change) {}

  /// A face plane that separates the parts, or 0.
  TALUS_HD SeparatingPlane classify_both(const BodyFrames& bodies) {
    const FrameChange a_to_b = bodies.a_to_b();
    tolerance_a = rounded(kCoplanarity * (a.range.radius + b_to_a.scale * b.range.radius));
    tolerance_b = rounded(kCoplanarity * (b.range.radius + a_to_b.scale * a.range.radius));
    // Of the smaller part only: a large one's vertices are far from a plane that is nearly flush.
    const bool is_b_smaller = b_to_a.scale * b.range.radius <= a.range.radius;
    const LocalReal near_a = is_b_smaller ? tolerance_a + rounded(kNearlyFlush * b_to_a.scale * b.range.radius) : 0;
    const LocalReal near_b = is_b_smaller ? 0 : tolerance_b + rounded(kNearlyFlush * a_to_b.scale * a.range.radius);
    transform_vertices(b, b_to_a, vertices_b);
    const int face_a = classify(a, vertices_b, near_a, sides_b);
    if (face_a >= 0) return static_cast<SeparatingPlane>(face_a + 1);
    transform_vertices(a, a_to_b, vertices_a);
    const int face_b = classify(b, vertices_a, near_b, sides_a);
    if (face_b >= 0) return static_cast<SeparatingPlane>(-face_b - 1);
    if (sides_a.near_count + sides_b.near_count > 0)
      flush.find(a, b, b_to_a, bodies.flush_rule(), is_b_smaller, is_b_smaller ? sides_b : sides_a,
                 is_b_smaller ? vertices_b : vertices_a, is_b_smaller ? near_a : near_b);
    return 0;
  }

  /// Faces lie flush: each of them is looked at from both sides.
  TALUS_HD bool is_flush() const { return flush.count > 0; }
  /// The body that reaches in with fewer of its vertices comes first: few of its faces lie inside, and they tell which
  /// of the other's are worth a look.
  TALUS_HD bool is_b_first() const { return sides_b.least_inside(vertices_b) <= sides_a.least_inside(vertices_a); }

  /// The part whose surface this is, and the one that it is cut by.
  TALUS_HD const PartView& surface(bool is_of_b) const { return is_of_b ? b : a; }
  TALUS_HD const PartView& solid(bool is_of_b) const { return is_of_b ? a : b; }
  /// Of the surface, in the solid's frame, and by the solid's planes.
  TALUS_HD const PartVertices& vertices(bool is_of_b) const { return is_of_b ? vertices_b : vertices_a; }
  TALUS_HD const PlaneSides& sides(bool is_of_b) const { return is_of_b ? sides_b : sides_a; }

  /// Visits the pieces of one part's wanted faces inside the other: visitor(polygon in the other's frame, face). False
  /// if a polygon was truncated.
  template <class Visitor>
  TALUS_HD bool visit(bool is_of_b, const FaceSet& wanted, Meeting& meeting, Visitor&& visitor) const {
    return visit_flush_surface_inside({flush, surface(is_of_b), solid(is_of_b), b_to_a, !is_of_b}, wanted,
                                      vertices(is_of_b), sides(is_of_b), is_of_b ? tolerance_a : tolerance_b, meeting,
                                      visitor);
  }

  /// The planes of one part that close what of the other one's surface is inside it: those that it reaches, and those
  /// of faces with a corner inside the other part, which it may surround.
  TALUS_HD FaceSet closing(bool is_of_b, const Meeting& met) const {
    const PartView& part = surface(is_of_b);
    FaceSet planes = met.reached;
    if (const std::uint64_t inside = sides(is_of_b).inside(vertices(is_of_b)); inside != 0)
      for (int f = 0; f < part.range.face_count; ++f)
        if ((part.faces[f].vertices & inside) != 0) planes.add(f);
    return planes;
  }

  /// The faces of one part that bound the overlap, once the other one's surface has been visited.
  TALUS_HD FaceSet bounding(bool is_of_b, const Meeting& met) {
    if (is_flush()) return FaceSet::all();
    return is_of_b ? faces_that_bound(b, a, met, vertices_b, sides_b)
                   : faces_that_bound(a, b, met, vertices_a, sides_a);
  }
};

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
