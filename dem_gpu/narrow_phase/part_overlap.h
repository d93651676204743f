// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"

namespace dem_gpu {

/// Which faces count that lie in a face plane of the other part. Opposed normals: none, the parts only touch there.
/// Equal normals: one of the two, the outer one rather than the inner one, else that of the open part; so coincident
/// faces count once, and a face in another body's cut plane as if there were no cut.
struct CoplanarRule {
  FaceMask planes;  // of the solid, that may hold such a face
  Real tolerance;   // [m]
  bool is_closed;   // the solid is the closed one of the two

  TALUS_HD bool keeps(const Polygon& face, bool is_inner_face, const PartView& solid) const {
    for (int f = 0; f < solid.range.face_count; ++f) {
      if (!planes.contains(f)) continue;
      const HalfSpace plane = solid.planes[f];
      bool lies_in_plane = true;
      for (int c = 0; c < face.count && lies_in_plane; ++c)
        lies_in_plane = std::abs(dot(plane.normal, face.corner[c]) - plane.offset) <= tolerance;
      if (!lies_in_plane) continue;
      const Vec3 area = cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
      if (dot(area, plane.normal) < 0) return false;
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
TALUS_HD bool visit_surface_inside(const PartView& surface, int face_count, const PartView& solid, const Vec3* vertices,
                                   const FaceMask* outcode, const CoplanarRule& coplanar, Visitor&& visitor) {
  Polygon buffer[2];
  for (int f = 0; f < face_count; ++f) {
    const FaceCorners face = surface.faces[f];
    const std::uint8_t* corner = surface.corners + face.first;
    FaceMask outside_all = outcode[corner[0]], outside_some = outside_all;
    for (int c = 1; c < face.count; ++c) {
      outside_all = outside_all & outcode[corner[c]];
      outside_some = outside_some | outcode[corner[c]];
    }
    if (!outside_all.is_empty()) continue;
    Polygon* polygon = &buffer[0];
    Polygon* other = &buffer[1];
    polygon->count = face.count;
    polygon->is_truncated = false;
    for (int c = 0; c < face.count; ++c) polygon->corner[c] = vertices[corner[c]];
    if (!coplanar.planes.is_empty() && !coplanar.keeps(*polygon, f >= surface.range.outer_face_count, solid)) continue;
    for (int plane = 0; plane < solid.range.face_count && polygon->count > 0; ++plane) {
      if (!outside_some.contains(plane)) continue;
      clip(*polygon, solid.planes[plane], *other);
      Polygon* swap = polygon;
      polygon = other;
      other = swap;
    }
    if (polygon->is_truncated) return false;
    if (polygon->count > 0) visitor(*polygon, f);
  }
  return true;
}

enum class OverlapStatus : std::uint8_t { separated, overlapping, polygon_truncated };

/// Sums `Integrals` over the overlap of part a of one body and part b of another. `b_to_a` and `a_to_b` are inverse
/// frame changes; `separating` is the pair's cache. `Integrals` provides:
///   kNeedsInnerFaces                            whether cut faces are visited too
///   add_surface_b(polygon, plane_b, part_a, b_to_a)   a piece of b's surface inside a, polygon in a's frame
///   add_surface_a(polygon, plane_a, part_b, b_to_a)   a piece of a's surface inside b, polygon in b's frame
template <class Integrals>
TALUS_HD OverlapStatus integrate_overlap(const PartView& a, const PartView& b, const FrameChange& b_to_a,
                                         const FrameChange& a_to_b, SeparatingPlane& separating, Integrals& integrals) {
  if (separating > 0 && lies_outside(b, a.planes[separating - 1], b_to_a)) return OverlapStatus::separated;
  if (separating < 0 && lies_outside(a, b.planes[-separating - 1], a_to_b)) return OverlapStatus::separated;
  separating = 0;

  ScratchArray<Vec3, kMaxPartVertices> vertices_b, vertices_a;
  ScratchArray<FaceMask, kMaxPartVertices> outcode_b, outcode_a;
  FaceMask coplanar_a, coplanar_b;
  const Real tolerance_a = kCoplanarity * (a.range.radius + b_to_a.scale * b.range.radius);
  const Real tolerance_b = kCoplanarity * (b.range.radius + a_to_b.scale * a.range.radius);
  for (int v = 0; v < b.range.vertex_count; ++v) vertices_b[v] = b_to_a.point(b.vertices[v]);
  const int face_a = classify(a, vertices_b.data(), b.range.vertex_count, tolerance_a, outcode_b.data(), coplanar_a);
  if (face_a >= 0) {
    separating = static_cast<SeparatingPlane>(face_a + 1);
    return OverlapStatus::separated;
  }
  for (int v = 0; v < a.range.vertex_count; ++v) vertices_a[v] = a_to_b.point(a.vertices[v]);
  const int face_b = classify(b, vertices_a.data(), a.range.vertex_count, tolerance_b, outcode_a.data(), coplanar_b);
  if (face_b >= 0) {
    separating = static_cast<SeparatingPlane>(-face_b - 1);
    return OverlapStatus::separated;
  }

  const int faces_b = Integrals::kNeedsInnerFaces ? b.range.face_count : b.range.outer_face_count;
  const int faces_a = Integrals::kNeedsInnerFaces ? a.range.face_count : a.range.outer_face_count;
  const bool b_whole = visit_surface_inside(
      b, faces_b, a, vertices_b.data(), outcode_b.data(), {coplanar_a, tolerance_a, true},
      [&](Polygon& polygon, int face) { integrals.add_surface_b(polygon, b.planes[face], a, b_to_a); });
  const bool a_whole = visit_surface_inside(
      a, faces_a, b, vertices_a.data(), outcode_a.data(), {coplanar_b, tolerance_b, false},
      [&](Polygon& polygon, int face) { integrals.add_surface_a(polygon, a.planes[face], b, b_to_a); });
  return a_whole && b_whole ? OverlapStatus::overlapping : OverlapStatus::polygon_truncated;
}

}  // namespace dem_gpu
