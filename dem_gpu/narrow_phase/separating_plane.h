// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem_gpu/narrow_phase/part_vertices.h"

namespace dem_gpu {

/// The face plane that last separated two parts: face + 1 of a, or -(face + 1) of b; 0 for none. Contact of slow
/// bodies changes little in a step, so trying it first settles most separated pairs.
using SeparatingPlane = std::int16_t;

/// How far outside a plane in its own frame all vertices of a part lie [m]; negative if one lies inside.
TALUS_HD TALUS_DEVICE_CALL inline Real distance_outside(const PartView& part, const HalfSpace& plane) {
  const int blocks = (part.range.vertex_count + kLanes - 1) / kLanes;
  WideLanes deepest = depths_below(plane, widened(load_points(part.vertex_blocks[0])));
  for (int i = 1; i < blocks; ++i)
    deepest = greatest(deepest, depths_below(plane, widened(load_points(part.vertex_blocks[i]))));
  return -greatest_lane(deepest);
}
/// The same for a plane in the frame that `to_plane` leads to, in that frame's lengths. The plane in the part's own
/// frame takes one transformation instead of one per vertex.
TALUS_HD inline Real distance_outside(const PartView& part, const HalfSpace& plane, const FrameChange& to_plane) {
  return distance_outside(part, {to_plane.scale * transpose_times(to_plane.rotation, plane.normal),
                                 plane.offset - dot(plane.normal, to_plane.translation)});
}
/// A plane of another frame, from which `change` leads here.
TALUS_HD inline HalfSpace moved(const FrameChange& change, const HalfSpace& plane) {
  const Vec3 normal = change.direction(plane.normal);
  return {normal, change.scale * plane.offset + dot(normal, change.translation)};
}

/// Planes within this distance, over the size of the two parts, count as one: above the rounding of vertices and planes
/// (a few units in the last place), far below any overlap that matters.
constexpr Real kCoplanarity = local_tolerance(1e-12, 1e-6);

/// A set of faces of a part, or of the planes of one: a bit each.
struct FaceSet {
  static_assert(kMaxPartFaces <= 128);
  std::uint64_t low = 0, high = 0;

  TALUS_HD static FaceSet all() { return {~std::uint64_t{0}, ~std::uint64_t{0}}; }
  TALUS_HD bool is_empty() const { return (low | high) == 0; }
  TALUS_HD bool has(int i) const { return ((i < 64 ? low : high) >> (i & 63) & 1) != 0; }
  TALUS_HD void add(const FaceSet& more) { low |= more.low, high |= more.high; }
  TALUS_HD FaceSet without(const FaceSet& some) const { return {low & ~some.low, high & ~some.high}; }
  /// Of a set that is not empty.
  TALUS_HD int lowest() const { return low != 0 ? lowest_bit(low) : 64 + lowest_bit(high); }
  TALUS_HD FaceSet without_lowest() const {
    return low != 0 ? FaceSet{low & (low - 1), high} : FaceSet{0, high & (high - 1)};
  }
  TALUS_HD void add(int i) {
    const std::uint64_t bit = std::uint64_t{1} << (i & 63);
    low |= i < 64 ? bit : 0;
    high |= i < 64 ? 0 : bit;
  }
};

/// On which side of the planes of a convex solid a set of vertices lies.
struct PlaneSides {
  // Of each cutting plane: bit v for a vertex in front of it. Empty sets fill up the last eight.
  ScratchArray<std::uint64_t, kMaxPartFaces + kLanes> outside;
  ScratchArray<std::uint8_t, kMaxPartFaces + kLanes> plane;  // faces whose planes have vertices in front: they cut
  int plane_count;
  ScratchArray<std::uint8_t, kMaxPartFaces> near;  // faces whose planes three vertices and more are near to
  int near_count;

  TALUS_HD void fill_up() {
    for (int k = plane_count; k < plane_count + kLanes; ++k) outside[k] = 0;
  }
  /// Bit v for a vertex behind all planes.
  TALUS_HD std::uint64_t inside(const PartVertices& vertices) const {
    std::uint64_t any = 0;
    for (int k = 0; k < plane_count; ++k) any |= outside[k];
    return ~any & vertices.all();
  }
  /// The fewest of the vertices that any plane leaves inside; that one is the first.
  TALUS_HD int least_inside(const PartVertices& vertices) const {
    return plane_count > 0 ? vertices.count - count_bits(outside[0]) : vertices.count;
  }
};

/// Bit v for a vertex below the plane.
TALUS_HD inline std::uint64_t vertices_below(const LocalHalfSpace& plane, const PartVertices& vertices) {
  std::uint64_t below = 0;
  for (int i = 0; i < vertices.block_count(); ++i)
    below |= std::uint64_t{lanes_above(depths_below(plane, vertices.block(i)), Lanes{})} << (i * kLanes);
  return below & vertices.all();
}

/// Bit v for a vertex nearer to the plane than `near` [m].
TALUS_HD inline std::uint64_t vertices_near(const LocalHalfSpace& plane, const PartVertices& vertices, LocalReal near) {
  const Lanes near_squared = every_lane<Lanes>(near * near);
  std::uint64_t touching = 0;
  for (int i = 0; i < vertices.block_count(); ++i) {
    const Lanes depth = depths_below(plane, vertices.block(i));
    touching |= std::uint64_t{lanes_above(near_squared, depth * depth)} << (i * kLanes);
  }
  return touching & vertices.all();
}

/// Of a set of vertices, those in front of a plane and those nearer to it than some distance: bit v for vertex v.
struct PlaneSets {
  std::uint64_t in_front = 0, near = 0;
};

/// Vertices by one plane after the other. kBlocks: how many eights they are, so that they stay in registers; 0 for any
/// number.
template <int kBlocks>
class VerticesByPlane {
 public:
  TALUS_HD VerticesByPlane(const PartVertices& vertices, LocalReal near)
      : vertices_(vertices), near_squared_(every_lane<Lanes>(near * near)) {
    TALUS_UNROLL for (int i = 0; i < kBlocks; ++i) block_[i] = vertices.block(i);
  }
  TALUS_HD TALUS_INLINE PlaneSets operator()(const LocalHalfSpace& plane) const {
    PlaneSets sets;
    if constexpr (kBlocks > 0) {
      TALUS_UNROLL for (int i = 0; i < kBlocks; ++i) add(plane, block_[i], i, sets);
    } else {
      for (int i = 0; i < vertices_.block_count(); ++i) add(plane, vertices_.block(i), i, sets);
    }
    sets.in_front &= vertices_.all();
    sets.near &= vertices_.all();
    return sets;
  }

 private:
  TALUS_HD TALUS_INLINE void add(const LocalHalfSpace& plane, const LaneVec3& points, int i, PlaneSets& sets) const {
    const Lanes depth = depths_below(plane, points);
    sets.in_front |= std::uint64_t{lanes_above(Lanes{}, depth)} << (i * kLanes);
    sets.near |= std::uint64_t{lanes_above(near_squared_, depth * depth)} << (i * kLanes);
  }

  const PartVertices& vertices_;
  Lanes near_squared_;
  LaneVec3 block_[kBlocks > 0 ? kBlocks : 1];
};

/// See classify.
template <int kBlocks>
TALUS_HD TALUS_DEVICE_CALL int classify_blocks(const PartView& solid, const PartVertices& vertices, LocalReal near,
                                               PlaneSides& sides) {
  const VerticesByPlane<kBlocks> sort(vertices, near);
  const std::uint64_t all = vertices.all();
  int cutting = 0, near_count = 0, most_in_front = 0, best = 0;
  for (int f = 0; f < solid.range.face_count; ++f) {
    const PlaneSets sets = sort(solid.planes[f]);
    if (sets.in_front == all) return f;
    if (sets.near != 0) {
      // Three bits and more: clearing the lowest two leaves some.
      const std::uint64_t without_lowest = sets.near & (sets.near - 1);
      if ((without_lowest & (without_lowest - 1)) != 0) sides.near[near_count++] = static_cast<std::uint8_t>(f);
    }
    sides.outside[cutting] = sets.in_front;
    sides.plane[cutting] = static_cast<std::uint8_t>(f);
    const int count = count_bits(sets.in_front);
    best = count > most_in_front ? cutting : best;
    most_in_front = count > most_in_front ? count : most_in_front;
    cutting += static_cast<int>(sets.in_front != 0);
  }
  sides.plane_count = cutting;
  sides.near_count = near_count;
  sides.fill_up();
  // The plane with most vertices in front comes first: it settles most faces at once.
  if (cutting > 1) {
    const std::uint64_t outside = sides.outside[best];
    const std::uint8_t plane = sides.plane[best];
    sides.outside[best] = sides.outside[0];
    sides.plane[best] = sides.plane[0];
    sides.outside[0] = outside;
    sides.plane[0] = plane;
  }
  return -1;
}

/// Sorts the vertices (in the solid's frame) by the solid's planes, after Cohen and Sutherland's outcodes, and finds
/// the planes that three of them and more are nearer to than `near` [m]. Returns a face whose plane has all vertices in
/// front, or -1.
TALUS_HD inline int classify(const PartView& solid, const PartVertices& vertices, LocalReal near, PlaneSides& sides) {
#if !defined(__CUDACC__)
  if (vertices.block_count() == 1) return classify_blocks<1>(solid, vertices, near, sides);
  if (vertices.block_count() == 2) return classify_blocks<2>(solid, vertices, near, sides);
#endif
  return classify_blocks<0>(solid, vertices, near, sides);
}

}  // namespace dem_gpu
