// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"

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

}  // namespace dem_gpu
