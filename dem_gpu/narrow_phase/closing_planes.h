// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/separating_plane.h"

namespace dem_gpu {

/// Up to three planes of a solid that cut a surface, in general position: they have a point in common, the apex. Where
/// they alone cut it, the overlap is the surface's pieces inside the solid and caps in these planes, and it is the
/// union of the pyramids from the apex to the pieces, since those to the caps are flat. So the pieces tell all of its
/// volume integrals. Of the caps the divergence theorem tells the rest: with n the outward normals and A vector areas,
///   sum over caps of n A = -A of the pieces,   of n integral of x_i dA = V e_i - integral of x_i n dA over the pieces,
///   of n integral of |x|^2 dA = 2 integral of x dV - integral of |x|^2 n dA over the pieces,
/// each multiplied by the vectors dual to the caps' normals.
struct ClosingPlanes {
  static constexpr int kMost = 3;

  Vec3 apex;  // [m]
  int count = 0;
  // Of plane i; normal[i] . dual[j] is 1 for i == j, else 0. An inner plane is a cut of the body that the solid is a
  // part of.
  Vec3 normal[kMost], dual[kMost];
  bool is_outer[kMost]{};

  /// From the planes of `cutting`'s faces, in the solid's frame; the apex is near a point. False if they are more than
  /// three, or nearly parallel, or have outer faces and inner ones.
  TALUS_HD TALUS_DEVICE_CALL bool find(const PartView& solid, const FaceSet& cutting, const Vec3& near) {
    HalfSpace plane[kMost];
    if (count_bits(cutting.low) + count_bits(cutting.high) > kMost) return false;
    count = 0;
    for (FaceSet left = cutting; !left.is_empty(); left = left.without_lowest()) {
      const int f = left.lowest();
      is_outer[count] = f < solid.range.outer_face_count;
      if (solid.faces[f].plane != f || !has_one_kind(solid, f)) return false;
      plane[count] = solid.planes[f];
      normal[count] = plane[count].normal;
      ++count;
    }
    if (!find_duals()) return false;
    apex = near;
    for (int i = 0; i < count; ++i) apex += depth_below(plane[i], near) * dual[i];
    return true;
  }

  /// Seen from another frame.
  TALUS_HD ClosingPlanes moved(const FrameChange& change) const {
    ClosingPlanes result = *this;
    result.apex = change.point(apex);
    for (int i = 0; i < count; ++i) {
      result.normal[i] = change.direction(normal[i]);
      result.dual[i] = change.direction(dual[i]);
    }
    return result;
  }

  /// 1 along the normals of all outer planes, 0 along those of inner ones.
  TALUS_HD Vec3 dual_of_outer() const {
    Vec3 sum;
    for (int i = 0; i < count; ++i)
      if (is_outer[i]) sum += dual[i];
    return sum;
  }
  /// Of the outer caps, from that of the pieces [m2].
  TALUS_HD Vec3 outer_area(const Vec3& area_of_pieces) const {
    Vec3 sum;
    for (int i = 0; i < count; ++i)
      if (is_outer[i]) sum += -dot(dual[i], area_of_pieces) * normal[i];
    return sum;
  }

 private:
  /// Whether faces in the plane of face f, the first one in it, are all outer or all inner.
  TALUS_HD static bool has_one_kind(const PartView& solid, int f) {
    const int outer = solid.range.outer_face_count;
    for (int g = outer; g < solid.range.face_count; ++g)
      if (solid.faces[g].plane == f && f < outer) return false;
    return true;
  }

  /// False if planes are so nearly parallel that the apex may be far away.
  TALUS_HD bool find_duals() {
    constexpr Real kLeastDeterminant = Real(0.1);
    if (count == 1) dual[0] = normal[0];
    if (count < 2) return true;
    const Vec3 axis = cross(normal[0], normal[1]);
    const Vec3 third = count == kMost ? normal[2] : axis;
    const Real determinant = dot(axis, third);  // of two planes the square of their sine
    if (!(std::abs(determinant) > kLeastDeterminant)) return false;
    const Real factor = 1 / determinant;
    dual[0] = factor * cross(normal[1], third);
    dual[1] = factor * cross(third, normal[0]);
    if (count == kMost) dual[2] = factor * axis;
    return true;
  }
};

}  // namespace dem_gpu
