// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/narrow_phase/separating_plane.h"

namespace dem_gpu {

/// Visits each piece of `surface`'s faces that lies inside `solid`, both convex. `vertices` are the surface's, already in
/// the solid's frame, with their outcodes against the solid's planes. Each clipped face is an independent polygon; no
/// topology is built. visitor(polygon in the solid's frame, face index). Returns false if a polygon was truncated.
template <class Visitor>
TALUS_HD bool visit_surface_inside(const PartView& surface, int face_count, const PartView& solid, const Vec3* vertices,
                                   const FaceMask* outcode, Visitor&& visitor) {
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

  Vec3 vertices_b[kMaxPartVertices], vertices_a[kMaxPartVertices];
  FaceMask outcode_b[kMaxPartVertices], outcode_a[kMaxPartVertices];
  for (int v = 0; v < b.range.vertex_count; ++v) vertices_b[v] = b_to_a.point(b.vertices[v]);
  const int face_a = classify(a, vertices_b, b.range.vertex_count, true, outcode_b);
  if (face_a >= 0) {
    separating = static_cast<SeparatingPlane>(face_a + 1);
    return OverlapStatus::separated;
  }
  for (int v = 0; v < a.range.vertex_count; ++v) vertices_a[v] = a_to_b.point(a.vertices[v]);
  const int face_b = classify(b, vertices_a, a.range.vertex_count, false, outcode_a);
  if (face_b >= 0) {
    separating = static_cast<SeparatingPlane>(-face_b - 1);
    return OverlapStatus::separated;
  }

  const int faces_b = Integrals::kNeedsInnerFaces ? b.range.face_count : b.range.outer_face_count;
  const int faces_a = Integrals::kNeedsInnerFaces ? a.range.face_count : a.range.outer_face_count;
  const bool b_whole = visit_surface_inside(b, faces_b, a, vertices_b, outcode_b, [&](Polygon& polygon, int face) {
    integrals.add_surface_b(polygon, b.planes[face], a, b_to_a);
  });
  const bool a_whole = visit_surface_inside(a, faces_a, b, vertices_a, outcode_a, [&](Polygon& polygon, int face) {
    integrals.add_surface_a(polygon, a.planes[face], b, b_to_a);
  });
  return a_whole && b_whole ? OverlapStatus::overlapping : OverlapStatus::polygon_truncated;
}

}  // namespace dem_gpu
