// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// The face plane that last separated two parts: face + 1 of a, or -(face + 1) of b; 0 for none. Contact of slow
/// bodies changes little in a step, so trying it first settles most separated pairs.
using SeparatingPlane = std::int16_t;

/// True if all vertices of `part` lie outside the plane, given in the frame that `to_plane` leads to.
TALUS_HD inline bool lies_outside(const PartView& part, const HalfSpace& plane, const FrameChange& to_plane) {
  // The plane in the part's own frame: one transformation instead of one per vertex.
  const Vec3 normal = to_plane.scale * transpose_times(to_plane.rotation, plane.normal);
  const Real offset = plane.offset - dot(plane.normal, to_plane.translation);
  for (int v = 0; v < part.range.vertex_count; ++v)
    if (dot(normal, part.vertices[v]) < offset) return false;
  return true;
}

/// Planes within this distance, over the size of the two parts, count as one: above the rounding of vertices and planes
/// (a few units in the last place), far below any overlap that matters.
constexpr Real kCoplanarity = local_tolerance(1e-12, 1e-6);

/// On which side of the planes of a convex solid a set of vertices lies.
struct PlaneSides {
  ScratchArray<std::uint64_t, kMaxPartFaces> outside;  // of each cutting plane: bit v for a vertex in front of it
  ScratchArray<std::uint8_t, kMaxPartFaces> plane;     // faces whose planes have vertices in front: they cut
  int plane_count;
  ScratchArray<std::uint8_t, kMaxPartFaces> coplanar;  // faces whose planes hold three vertices and more
  int coplanar_count;
};

/// Bit v for a vertex higher than `height` over the plane.
TALUS_HD inline std::uint64_t vertices_above(const LocalHalfSpace& plane, const PartVertices& vertices,
                                             LocalReal height) {
  LaneBits above{};
  for (int first = 0; first < vertices.padded_count; first += kLanes)
    above |= bits_above(vertices.height_over(plane, first), height, first);
  return join(above);
}

/// Sorts the vertices (in the solid's frame) by the solid's planes, after Cohen and Sutherland's outcodes. Where three
/// vertices and more lie within `tolerance` [m] of a plane, a face may lie flush in it and they all count as inside;
/// one or two count as they lie, since the plane of a face that is nearly flush would be cut up to tolerance / angle
/// away. Returns a face whose plane has all vertices in front, or -1.
TALUS_HD inline int classify(const PartView& solid, const PartVertices& vertices, LocalReal tolerance,
                             PlaneSides& sides) {
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - vertices.count);
  sides.plane_count = sides.coplanar_count = 0;
  int most_in_front = 0, best = 0;
  for (int f = 0; f < solid.range.face_count; ++f) {
    const LocalHalfSpace plane = solid.planes[f];
    LaneBits in_front_lanes{}, touching_lanes{};
    for (int first = 0; first < vertices.padded_count; first += kLanes) {
      const Lanes height = vertices.height_over(plane, first);
      in_front_lanes |= bits_above(height, tolerance, first);
      touching_lanes |= bits_above(height, -tolerance, first);
    }
    std::uint64_t in_front = join(in_front_lanes) & all;
    const std::uint64_t touching = join(touching_lanes) & all & ~in_front;
    // Three bits and more: clearing the lowest two leaves some.
    const std::uint64_t without_lowest = touching & (touching - 1);
    const bool is_coplanar = (without_lowest & (without_lowest - 1)) != 0;
    if (touching != 0 && !is_coplanar) in_front |= vertices_above(plane, vertices, 0) & all;
    if (in_front == all) return f;
    if (in_front != 0) {
      const int count = count_bits(in_front);
      sides.outside[sides.plane_count] = in_front;
      sides.plane[sides.plane_count] = static_cast<std::uint8_t>(f);
      if (count > most_in_front) most_in_front = count, best = sides.plane_count;
      ++sides.plane_count;
    }
    if (is_coplanar) sides.coplanar[sides.coplanar_count++] = static_cast<std::uint8_t>(f);
  }
  // The plane with most vertices in front comes first: it settles most faces at once.
  if (sides.plane_count > 1) {
    const std::uint64_t outside = sides.outside[best];
    const std::uint8_t plane = sides.plane[best];
    sides.outside[best] = sides.outside[0];
    sides.plane[best] = sides.plane[0];
    sides.outside[0] = outside;
    sides.plane[0] = plane;
  }
  return -1;
}

}  // namespace dem_gpu
