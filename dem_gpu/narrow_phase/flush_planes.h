// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "dem_gpu/narrow_phase/separating_plane.h"

namespace dem_gpu {

/// Face planes of two parts closer than this, in sine and in distance over the smaller part's size, are looked at
/// together. Apart from each other, each part's vertices against the other's planes, the edge where two faces cross
/// would come out at two places, rounding / angle apart: what lies between would count twice or not at all.
constexpr Real kNearlyFlush = local_tolerance(1e-6, 1e-3);

/// What two bodies' planes are compared by, in a's unscaled frame. Of the bodies, not of their parts: where a face lies
/// in a cut of the other body, the parts on both sides of the cut must tell the same.
struct FlushRule {
  Vec3 middle;         // between the bodies' centres: the rule is the same whichever of them is a [m]
  Real reach = 0;      // of both bodies from there [m]
  Real tolerance = 0;  // planes nowhere further apart than this within reach are one [m]

  TALUS_HD static FlushRule of(Real radius_a, Real radius_b, const Vec3& from_a_to_b) {
    const Real smaller_radius = radius_a < radius_b ? radius_a : radius_b;
    return {Real(0.5) * from_a_to_b, Real(0.5) * norm(from_a_to_b) + smaller_radius,
            kCoplanarity * (radius_a + radius_b)};
  }
};

/// Of opposed planes, one of each part: what lies between the two. Else what lies inside a's, seen from b's. In a's
/// frame. In one copy, since faces of both parts are cut by it and must meet to the last bit.
TALUS_HD TALUS_ONE_COPY inline HalfSpace between_planes(const HalfSpace& of_a, const HalfSpace& of_b,
                                                        const FrameChange& b_to_a) {
  const Vec3 normal_b = b_to_a.direction(of_b.normal);
  const Real offset_b = b_to_a.scale * of_b.offset + dot(normal_b, b_to_a.translation);
  const Real sign = dot(of_a.normal, normal_b) < 0 ? 1 : -1;
  return {of_a.normal + sign * normal_b, of_a.offset + sign * offset_b};
}

/// The pairs of face planes, one of each part, that are nearly one plane. Which of two such faces bounds the overlap,
/// or whether the parts have reached each other there, is decided by the distance between the two planes: the same
/// number for the faces of both.
struct FlushPlanes {
  struct Pair {
    std::uint8_t plane_a, plane_b;  // first faces in them
    bool is_opposed;
    bool is_one;  // but for rounding
  };
  static constexpr int kMost = kMaxPartFaces;
  ScratchArray<Pair, kMost> pair;
  int count = 0;

  /// `sides`: b's `vertices` by the planes of a, or a's by those of b, and what is near is nearer than `near` [m].
  TALUS_HD TALUS_DEVICE_CALL void find(const PartView& a, const PartView& b, const FrameChange& b_to_a,
                                       const FlushRule& rule, bool is_by_a, const PlaneSides& sides,
                                       const PartVertices& vertices, LocalReal near) {
    const PartView &solid = is_by_a ? a : b, &surface = is_by_a ? b : a;
    for (int k = 0; k < sides.near_count; ++k) {
      const int plane = sides.near[k];
      if (solid.faces[plane].plane != plane) continue;
      const std::uint64_t touching = vertices_near(solid.planes[plane], vertices, near);
      for (int f = 0; f < surface.range.face_count; ++f)
        if (surface.faces[f].plane == f && (surface.faces[f].vertices & ~touching) == 0)
          add(a, is_by_a ? plane : f, b, is_by_a ? f : plane, b_to_a, rule);
    }
  }

 private:
  TALUS_HD void add(const PartView& a, int plane_a, const PartView& b, int plane_b, const FrameChange& b_to_a,
                    const FlushRule& rule) {
    const HalfSpace of_a = a.planes[plane_a], of_b = b.planes[plane_b];
    const HalfSpace between = between_planes(of_a, of_b, b_to_a);
    const Real sine = norm(between.normal);
    if (sine > kNearlyFlush || count == kMost) return;
    const bool is_opposed = dot(of_a.normal, b_to_a.direction(of_b.normal)) < 0;
    const Real gap = between.offset - dot(between.normal, rule.middle);
    const bool is_one = std::abs(gap) + sine * rule.reach <= rule.tolerance;
    pair[count++] = {static_cast<std::uint8_t>(plane_a), static_cast<std::uint8_t>(plane_b), is_opposed, is_one};
  }
};

/// One part's side of the flush planes: its surface is cut by the other part, the solid.
struct FlushSide {
  const FlushPlanes& planes;
  const PartView& surface;
  const PartView& solid;
  const FrameChange& b_to_a;
  bool is_a;  // the surface is a's

  /// The surface's faces in flush planes.
  TALUS_HD FaceSet faces() const {
    FaceSet flush;
    for (int f = 0; f < surface.range.face_count; ++f)
      for (int p = 0; p < planes.count; ++p)
        if (own_plane(planes.pair[p]) == surface.faces[f].plane) flush.add(f);
    return flush;
  }

  TALUS_HD int own_plane(const FlushPlanes::Pair& pair) const { return is_a ? pair.plane_a : pair.plane_b; }
  TALUS_HD int other_plane(const FlushPlanes::Pair& pair) const { return is_a ? pair.plane_b : pair.plane_a; }

  /// Whether faces of the surface count at all in a plane that is also the other part's. Opposed planes: unless one of
  /// them is a cut, since the parts beyond see it as well. Else the faces of one part count: the outer ones rather than
  /// the inner ones, so a face in another body's cut as if there were no cut, otherwise b's.
  TALUS_HD bool counts(const FlushPlanes::Pair& pair) const {
    const bool is_inner = own_plane(pair) >= surface.range.outer_face_count;
    const bool is_other_inner = other_plane(pair) >= solid.range.outer_face_count;
    if (pair.is_opposed) return !is_inner && !is_other_inner;
    return is_inner == is_other_inner ? !is_a : is_other_inner;
  }

  /// Where a face of the surface in the pair's planes counts, in the solid's frame.
  TALUS_HD LocalHalfSpace where_it_counts(const FlushPlanes::Pair& pair) const {
    const PartView &a = is_a ? surface : solid, &b = is_a ? solid : surface;
    const HalfSpace between = between_planes(a.planes[pair.plane_a], b.planes[pair.plane_b], b_to_a);
    if (!is_a) return rounded(between);
    const Real sign = pair.is_opposed ? 1 : -1;
    const Vec3 normal = sign * between.normal;
    return rounded(HalfSpace{b_to_a.scale * transpose_times(b_to_a.rotation, normal),
                             sign * between.offset - dot(normal, b_to_a.translation)});
  }
};

/// A solid as a face sees it that is flush with some of its planes: in their place stand the planes where the face's
/// own plane crosses them.
struct FlushSolid {
  PlaneSides sides;
  ScratchArray<LocalHalfSpace, kMaxPartFaces> planes;

  /// False if nothing of the face counts. `vertices` of the surface in the solid's frame, `all_sides` by its planes.
  TALUS_HD TALUS_DEVICE_CALL bool set(const FlushSide& side, int face, const PartVertices& vertices,
                                      const PlaneSides& all_sides) {
    const int own = side.surface.faces[face].plane;
    FaceSet replaced;
    sides.plane_count = 0;
    for (int p = 0; p < side.planes.count; ++p) {
      const FlushPlanes::Pair& pair = side.planes.pair[p];
      if (side.own_plane(pair) != own) continue;
      const int other = side.other_plane(pair);
      replaced.add(other);
      if (pair.is_one && !side.counts(pair)) return false;
      if (pair.is_one && !pair.is_opposed) continue;
      const LocalHalfSpace plane = side.where_it_counts(pair);
      // What is no more than in the plane does not count: of planes that are one to the last bit, nothing.
      add(other, plane, vertices.all() & ~vertices_below(plane, vertices));
    }
    for (int k = 0; k < all_sides.plane_count; ++k) {
      const int f = all_sides.plane[k];
      if (!replaced.has(side.solid.faces[f].plane)) add(f, side.solid.planes[f], all_sides.outside[k]);
    }
    sides.fill_up();
    return true;
  }

 private:
  TALUS_HD void add(int f, const LocalHalfSpace& plane, std::uint64_t outside) {
    planes[f] = plane;
    sides.outside[sides.plane_count] = outside;
    sides.plane[sides.plane_count++] = static_cast<std::uint8_t>(f);
  }
};

}  // namespace dem_gpu
