// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <type_traits>

#include "dem_gpu/contacts/elastic_contact.h"
#include "dem_gpu/narrow_phase/closing_planes.h"
#include "dem_gpu/narrow_phase/part_overlap.h"
#include "dem_gpu/narrow_phase/patch_sums.h"
#include "dem_gpu/narrow_phase/surface_triangles.h"

namespace dem_gpu {

/// Overlap integrals V, S, M of two bodies in a's unscaled body frame, additive over part pairs: inner faces are
/// visited too and cancel. Feng, Comput. Methods Appl. Mech. Eng. 373 (2021) 113493; divergence theorem about a point
/// of the overlap, not the world's origin. Polygons in the precision of contact geometry, sums in Real. For friction
/// all of the contact is one patch along S.
template <class Sums>
struct VolumeIntegralsOf {
  static constexpr bool kNeedsDepth = false;
  static constexpr bool kHasPatch = std::is_same_v<Sums, PatchSums>;

  Real volume = 0;                 // V [m3]
  Vec3 area;                       // S = integral over a's surface in b of n dA [m2]
  Vec3 area_moment;                // M = integral over the same of x cross n dA, about a's centre [m3]
  Vec3 first_moment;               // integral of (x - reference) dV [m4]
  Mat3 second_moment{{}, {}, {}};  // integral of (x - reference) (x - reference)^T dV [m5]
  Vec3 reference;                  // a point of the overlap [m]
  bool has_reference = false;
  std::conditional_t<kHasPatch, AreaPatchSums, NoPatchSums> patch;  // of the area

  /// Adds the overlap of two parts from one part's surface inside the other alone, which these planes close. All in
  /// a's frame; `is_of_b`: the surface is b's. False, and nothing is added, in single precision where the overlap is a
  /// thin slice of the pyramids.
  TALUS_HD bool add_closed(const SurfaceTriangles& surface, bool is_of_b, const ClosingPlanes& planes) {
    const Vec3 apex = LocalVec3(rounded(planes.apex)), weight = planes.dual_of_outer();
    const SurfaceSums sums = sums_over(surface, apex, weight);
    if (kIsSingle && sums.volume < kThinSlice * sums.pyramids) return false;
    if (!has_reference) reference = surface.point(0), has_reference = true;
    add_volume(sums, apex);
    add_force_side(sums, apex, is_of_b ? -1 : 1);
    if constexpr (kHasPatch) {
      add_patch_side(is_of_b, sums.outer_area, sums.outer_vector_area);
      const Vec3 caps = planes.outer_area(sums.area);
      const Real area_of_caps = std::max(-dot(weight, sums.area), Real(0));
      add_patch_side(!is_of_b, area_of_caps, caps);
      add_patch_moments(apex, sums.outer_area + area_of_caps, sums.area_first + sums.volume * weight,
                        sums.area_second + 2 * dot(weight, sums.first_moment));
    }
    return true;
  }

  /// Adds one part's surface inside the other; the other part's must be added too.
  TALUS_HD void add_surface(const SurfaceTriangles& surface, bool is_of_b) {
    if (!has_reference) reference = surface.point(0), has_reference = true;
    const Vec3 apex = LocalVec3(rounded(reference));
    const SurfaceSums sums = sums_over(surface, apex, {});
    add_volume(sums, apex);
    if (!is_of_b) add_force_side(sums, apex, 1);
    if constexpr (kHasPatch) {
      add_patch_side(is_of_b, sums.outer_area, sums.outer_vector_area);
      add_patch_moments(apex, sums.outer_area, sums.area_first, sums.area_second);
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
    return {patch.normals(a.rotation), norm(contact.force), a.scale * patch.lever(), law.stiffness_per_area()};
  }

 private:
  static constexpr bool kIsSingle = sizeof(LocalReal) < sizeof(Real);
  /// Share of the pyramids that the overlap is at least: of a thinner slice the moments are lost in their rounding.
  static constexpr Real kThinSlice = Real(0.1);

  /// Sums over one part's surface inside the other, x from an apex; pyramids are those from there to the surface.
  struct SurfaceSums {
    Real volume;             // of the pyramids [m3]
    Real pyramids = 0;       // in single precision: the sum of their absolute volumes [m3]
    Vec3 area, area_moment;  // integrals of n dA [m2] and x cross n dA [m3]
    Vec3 first_moment;       // of the pyramids [m4]
    Mat3 second_moment;      // [m5]
    // Of outer faces, with friction.
    Real outer_area;         // [m2]
    Vec3 outer_vector_area;  // [m2]
    // Integrals of x dA [m3] and |x|^2 dA [m4], less those of all faces weighted by n . weight.
    Vec3 area_first;
    Real area_second;
  };

  TALUS_HD static TALUS_INLINE SurfaceSums sums_over(const SurfaceTriangles& surface, const Vec3& apex,
                                                     const Vec3& weight) {
    const LocalVec3 origin = rounded(apex), along = rounded(weight);
    WideLanes volumes[kLanes]{}, seconds[kLanes]{}, patches[kLanes]{}, pyramids{};
    for (int block = 0; block < surface.block_count(); ++block) {
      const LaneVec3 a = surface.corners(0, block) - origin, b = surface.corners(1, block) - origin,
                     c = surface.corners(2, block) - origin, sum = a + b + c;
      const LaneVec3 area = LocalReal(0.5) * cross(b - a, c - a);
      const LaneVec3 moment = (LocalReal(1) / 3) * cross(sum, area);
      const Lanes pyramid = (LocalReal(1) / 3) * dot(a, area);
      const LaneVec3 first = (LocalReal(0.25) * pyramid) * sum;  // its centroid lies at 3/4 of the way to the base's
      const LaneVec3 square{a.x * a.x + b.x * b.x + c.x * c.x + sum.x * sum.x,
                            a.y * a.y + b.y * b.y + c.y * c.y + sum.y * sum.y,
                            a.z * a.z + b.z * b.z + c.z * c.z + sum.z * sum.z};
      const Lanes share = LocalReal(0.05) * pyramid;
      const auto product = [&](const Lanes& ai, const Lanes& aj, const Lanes& bi, const Lanes& bj, const Lanes& ci,
                               const Lanes& cj, const Lanes& si,
                               const Lanes& sj) { return share * (ai * aj + bi * bj + ci * cj + si * sj); };
      if constexpr (kIsSingle) pyramids += widened(greatest(pyramid, Lanes{} - pyramid));
      add(volumes, pyramid, area, first);
      volumes[7] += widened(moment.x);
      const Lanes xy = product(a.x, a.y, b.x, b.y, c.x, c.y, sum.x, sum.y);
      const Lanes yz = product(a.y, a.z, b.y, b.z, c.y, c.z, sum.y, sum.z);
      const Lanes zx = product(a.z, a.x, b.z, b.x, c.z, c.x, sum.z, sum.x);
      add(seconds, moment.y, share * square, {xy, yz, zx});
      seconds[7] += widened(moment.z);
      if constexpr (kHasPatch) {
        const Lanes outer = surface.outer(block), outer_area = outer * roots(norm_squared(area));
        const Lanes weighted = outer_area - dot(along, area);
        add(patches, outer_area, outer * area, ((LocalReal(1) / 3) * weighted) * sum);
        patches[7] += widened((LocalReal(1) / 12) * weighted * (square.x + square.y + square.z));
      }
    }
    const WideLanes v = sums_of_lanes(volumes), s = sums_of_lanes(seconds);
    SurfaceSums sums{v[0],
                     kIsSingle ? sum_of_lanes(pyramids) : 0,
                     {v[1], v[2], v[3]},
                     {v[7], s[0], s[7]},
                     {v[4], v[5], v[6]},
                     {{s[1], s[4], s[6]}, {s[4], s[2], s[5]}, {s[6], s[5], s[3]}},
                     0,
                     {},
                     {},
                     0};
    if constexpr (kHasPatch) {
      const WideLanes p = sums_of_lanes(patches);
      sums.outer_area = p[0];
      sums.outer_vector_area = {p[1], p[2], p[3]};
      sums.area_first = {p[4], p[5], p[6]};
      sums.area_second = p[7];
    }
    return sums;
  }
  /// Into the first seven.
  TALUS_HD static TALUS_INLINE void add(WideLanes (&sums)[kLanes], const Lanes& first, const LaneVec3& next,
                                        const LaneVec3& last) {
    sums[0] += widened(first);
    sums[1] += widened(next.x);
    sums[2] += widened(next.y);
    sums[3] += widened(next.z);
    sums[4] += widened(last.x);
    sums[5] += widened(last.y);
    sums[6] += widened(last.z);
  }

  TALUS_HD void add_volume(const SurfaceSums& sums, const Vec3& apex) {
    const Vec3 shift = apex - reference, first = sums.first_moment, moved = first + sums.volume * shift;
    volume += sums.volume;
    first_moment += moved;
    const auto column = [&](const Vec3& about_apex, Real first_i, Real shift_i) {
      return about_apex + shift_i * moved + first_i * shift;
    };
    second_moment.column_x += column(sums.second_moment.column_x, first.x, shift.x);
    second_moment.column_y += column(sums.second_moment.column_y, first.y, shift.y);
    second_moment.column_z += column(sums.second_moment.column_z, first.z, shift.z);
  }
  /// Of a closed surface both integrals are zero, so b's surface tells a's with the other sign.
  TALUS_HD void add_force_side(const SurfaceSums& sums, const Vec3& apex, Real sign) {
    area += sign * sums.area;
    area_moment += sign * (sums.area_moment + cross(apex, sums.area));
  }

  /// The force on a points along b's normals and against a's. The whole side counts as one contact.
  TALUS_HD void add_patch_side(bool is_of_b, Real area_of_side, const Vec3& vector_area) {
    (is_of_b ? patch.side_b : patch.side_a).add(area_of_side, is_of_b ? vector_area : -vector_area);
  }
  /// From moments about an apex.
  TALUS_HD void add_patch_moments(const Vec3& apex, Real area_of_patch, const Vec3& first, Real second) {
    patch.weight += area_of_patch;
    patch.first_moment += first + area_of_patch * apex;
    patch.second_moment += second + 2 * dot(apex, first) + norm_squared(apex) * area_of_patch;
  }
};
using VolumeIntegrals = VolumeIntegralsOf<NoPatchSums>;

}  // namespace dem_gpu
