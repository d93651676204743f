// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "dem_gpu/narrow_phase/flush_planes.h"
#include "dem_gpu/narrow_phase/surface_inside.h"

namespace dem_gpu {

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

}  // namespace dem_gpu
