// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/narrow_phase/depth_profile.h"
#include "dem_gpu/narrow_phase/moment_origin.h"
#include "dem_gpu/narrow_phase/part_overlap.h"
#include "dem_gpu/narrow_phase/patch_sums.h"

namespace dem_gpu {

/// Overlap integrals V, S, M of two bodies in a's unscaled body frame, additive over part pairs: inner faces are
/// visited too and cancel. Feng, Comput. Methods Appl. Mech. Eng. 373 (2021) 113493; divergence theorem about a point
/// of the overlap, not the world's origin. Polygons in the precision of contact geometry, sums in Real. For friction
/// all of the contact is one patch along S.
template <class Sums>
struct VolumeIntegralsOf {
  static constexpr bool kNeedsInnerFaces = true;
  static constexpr bool kNeedsDepthPlanes = false;
  static constexpr bool kHasPatch = std::is_same_v<Sums, PatchSums>;

  Real volume = 0;                 // V [m3]
  Vec3 area;                       // S = integral over a's surface in b of n dA [m2]
  Vec3 area_moment;                // M = integral over the same of x cross n dA, about a's centre [m3]
  Vec3 first_moment;               // integral of (x - reference) dV [m4]
  Mat3 second_moment{{}, {}, {}};  // integral of (x - reference) (x - reference)^T dV [m5]
  Vec3 reference;                  // a point of the overlap [m]
  bool has_reference = false;
  Sums patch;  // of the area

  TALUS_HD void add_surface_b(const Polygon& polygon, const LocalHalfSpace& plane_b, bool is_outer, const PartView&,
                              const FrameChange& b_to_a) {
    const LocalVec3 normal = rounded(b_to_a.direction(plane_b.normal));
    add_volume(polygon, normal);
    if constexpr (kHasPatch)
      if (is_outer) add_area(patch.side_b, polygon, normal, 1);
  }

  TALUS_HD void add_surface_a(Polygon& polygon, const LocalHalfSpace& plane_a, bool is_outer, const PartView&,
                              const FrameChange& b_to_a) {
    for (int c = 0; c < polygon.count; ++c) polygon.corner[c] = rounded(b_to_a.point(polygon.corner[c]));
    const LocalVec3& normal = plane_a.normal;
    add_volume(polygon, normal);
    if constexpr (kHasPatch)
      if (is_outer) add_area(patch.side_a, polygon, normal, -1);
    const LocalVec3 a = polygon.corner[0];
    for (int c = 2; c < polygon.count; ++c) {
      const LocalVec3 b = polygon.corner[c - 1], d = polygon.corner[c];
      const LocalReal triangle = dot(cross(b - a, d - a), normal) / 2;
      area += Real(triangle) * Vec3(normal);
      area_moment += Vec3(cross((triangle / 3) * (a + b + d), normal));
    }
  }

  TALUS_HD Vec3 centroid() const { return volume > 0 ? reference + (1 / volume) * first_moment : reference; }

  /// Depth of the overlap along the unit vector n of S: for V ~ depth^p it is p times the mean depth V / |S|. p shows
  /// in the spread of the overlap along n: variance over the mean depth squared is p^3 / ((p + 1)^2 (p + 2)).
  TALUS_HD Real depth_along(const Vec3& n) const {
    constexpr Real kFlat = Real(1) / 12, kEdge = Real(2) / 9, kCorner = Real(27) / 80;  // p = 1, 2, 3
    const Real mean_depth = volume / norm(area), centre = dot(first_moment, n) / volume;
    const Real variance = dot(n, second_moment * n) / volume - centre * centre;
    const Real spread = std::min(std::max(variance / (mean_depth * mean_depth), kFlat), kCorner);
    const Real power = spread < kEdge ? 1 + (spread - kFlat) / (kEdge - kFlat)  // to 0.03 between the three
                                      : 2 + (spread - kEdge) / (kCorner - kEdge);
    return power * mean_depth;
  }

  /// F = k V n at the centroid of the overlap, n along S.
  TALUS_HD bool to_contact(const OverlapVolume& law, const Pose& a, ElasticContact& contact) const {
    const Real area_norm = norm(area);
    if (!(volume > 0) || !(area_norm > 0)) return false;
    const Real square = a.scale * a.scale, cube = square * a.scale;
    const Vec3 branch = a.scale * (a.rotation * centroid());
    contact.force = (-law.stiffness * cube * volume / area_norm) * (a.rotation * area);
    contact.torque_a = cross(branch, contact.force);
    contact.point = a.position + branch;
    contact.stiffness = law.stiffness * square * area_norm;
    contact.depth = a.scale * depth_along((1 / area_norm) * area);
    return set_normal(contact);
  }

  TALUS_HD ContactPatch to_patch(const OverlapVolume& law, const Pose& a,
                                 const ElasticContact& contact) const requires kHasPatch {
    return {rotated(patch.normals(), a.rotation), norm(contact.force), a.scale * patch.lever(),
            law.stiffness_per_area()};
  }

 private:
  /// `sign`: the force on a points along b's normals and against a's.
  TALUS_HD void add_area(PatchSide& side, const Polygon& polygon, const LocalVec3& normal, Real sign) {
    const MomentOrigin origin = MomentOrigin::at(polygon.corner[0]);
    const LocalVec3 a = origin.to(polygon.corner[0]);
    for (int c = 2; c < polygon.count; ++c) {
      const LocalVec3 b = origin.to(polygon.corner[c - 1]), d = origin.to(polygon.corner[c]);
      const LocalReal triangle = LocalReal(0.5) * dot(cross(b - a, d - a), normal);
      const LocalVec3 first = (triangle / 3) * (a + b + d);
      const LocalReal second = LinearProfile{}.second_moment({a, b, d, 1, 1, 1, triangle});
      patch.add(side, triangle, 0, sign * Vec3(normal), origin.first_about_centre(first, triangle),
                origin.second_about_centre(second, first, triangle));
    }
  }
  TALUS_HD void add_volume(const Polygon& polygon, const LocalVec3& normal) {
    if (!has_reference) reference = polygon.corner[0], has_reference = true;
    const LocalVec3 origin = rounded(reference), a = polygon.corner[0] - origin;
    const LocalReal height = dot(a, normal);  // the same over the plane of the polygon
    for (int c = 2; c < polygon.count; ++c) {
      const LocalVec3 b = polygon.corner[c - 1] - origin, d = polygon.corner[c] - origin;
      const LocalReal triangle = dot(cross(b - a, d - a), normal) / 2;
      const LocalReal pyramid = triangle * height / 3;  // to the reference point
      volume += pyramid;
      // Its centroid lies at 3/4 of the way to the base's.
      const LocalVec3 corners[4] = {a, b, d, a + b + d};
      first_moment += Vec3(pyramid / 4 * corners[3]);
      for (const LocalVec3& corner : corners) add_outer_product(second_moment, pyramid / 20, Vec3(corner));
    }
  }
};
using VolumeIntegrals = VolumeIntegralsOf<NoPatchSums>;

}  // namespace dem_gpu
