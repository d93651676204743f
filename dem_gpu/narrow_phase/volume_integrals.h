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

  /// What friction needs of one side's surface inside the other.
  struct SideLanes {
    WideLanes area{};
    WideLaneVec3 vector_area{};  // outwards
  };
  /// The sums of the pair of parts at hand, lane by lane: `finish` adds them up.
  struct LaneSums {
    WideLanes volume{};
    WideLaneVec3 area{}, area_moment{}, first_moment{};
    WideLanes xx{}, xy{}, xz{}, yy{}, yz{}, zz{};  // of the second moment
    // With friction.
    SideLanes side_a, side_b;
    WideLaneVec3 patch_first{};
    WideLanes patch_second{};
  };
  LaneSums lanes;

  TALUS_HD void add_surface_b(const Polygon& polygon, const LocalHalfSpace& plane_b, bool is_outer, const PartView&,
                              const FrameChange& b_to_a) {
    const LocalVec3 normal = rounded(b_to_a.direction(plane_b.normal));
    const Fan fan(polygon.corners, normal);
    add_volume(fan, normal);
    if constexpr (kHasPatch)
      if (is_outer) add_area(lanes.side_b, fan, normal);
  }

  TALUS_HD void add_surface_a(const Polygon& polygon, const LocalHalfSpace& plane_a, bool is_outer, const PartView&,
                              const FrameChange& b_to_a) {
    const LocalVec3& normal = plane_a.normal;
    const Fan fan(rounded(moved(b_to_a, widened(polygon.corners))), normal);
    add_volume(fan, normal);
    if constexpr (kHasPatch)
      if (is_outer) add_area(lanes.side_a, fan, normal);
    const WideLaneVec3 first = widened((LocalReal(1) / 3) * fan.area * (fan.a + fan.b + fan.c));
    const Vec3 n = normal;
    const WideLanes part = widened(fan.area);
    lanes.area += {n.x * part, n.y * part, n.z * part};
    lanes.area_moment += {n.z * first.y - n.y * first.z, n.x * first.z - n.z * first.x, n.y * first.x - n.x * first.y};
  }

  /// Ends a pair of parts.
  TALUS_HD void finish() {
    volume += sum_of_lanes(lanes.volume);
    area += sum_of_lanes(lanes.area);
    area_moment += sum_of_lanes(lanes.area_moment);
    first_moment += sum_of_lanes(lanes.first_moment);
    const Real xy = sum_of_lanes(lanes.xy), xz = sum_of_lanes(lanes.xz), yz = sum_of_lanes(lanes.yz);
    second_moment.column_x += Vec3{sum_of_lanes(lanes.xx), xy, xz};
    second_moment.column_y += Vec3{xy, sum_of_lanes(lanes.yy), yz};
    second_moment.column_z += Vec3{xz, yz, sum_of_lanes(lanes.zz)};
    if constexpr (kHasPatch) {
      add_side(patch.side_a, lanes.side_a, -1);
      add_side(patch.side_b, lanes.side_b, 1);
      patch.first_moment += sum_of_lanes(lanes.patch_first);
      patch.second_moment += sum_of_lanes(lanes.patch_second);
    }
    lanes = {};
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
  /// The triangles of a polygon's fan, a lane each.
  struct Fan {
    LaneVec3 a, b, c;
    Lanes area;

    TALUS_HD Fan(const LaneVec3& corners, const LocalVec3& normal)
        : a(first_lane(corners)), b(corners), c(next_lane(corners)) {
      area = LocalReal(0.5) * dot(normal, cross(b - a, c - a));
    }
  };

  /// `sign`: the force on a points along b's normals and against a's. The whole side counts as one contact.
  TALUS_HD void add_side(PatchSide& side, const SideLanes& sums, Real sign) {
    const Real area_of_side = sum_of_lanes(sums.area);
    const Vec3 direction = sign * sum_of_lanes(sums.vector_area);
    side.pointed += direction;
    side.total += direction;
    side.weight += area_of_side;
    patch.weight += area_of_side;
  }
  /// Adds a piece of a side's outer surface to what friction needs.
  TALUS_HD TALUS_INLINE void add_area(SideLanes& side, const Fan& fan, const LocalVec3& normal) {
    const MomentOrigin origin = MomentOrigin::at(point_at(fan.a, 0));
    const LaneVec3 a = origin.to(fan.a), b = origin.to(fan.b), c = origin.to(fan.c);
    const LaneVec3 first = (LocalReal(1) / 3) * fan.area * (a + b + c);
    const Lanes one = every_lane<Lanes>(LocalReal(1));
    const Lanes second = LinearProfile{}.second_moment(DepthTriangles{a, b, c, one, one, one, fan.area});
    const WideLanes area = widened(fan.area);
    const Vec3 n = normal;
    side.area += area;
    side.vector_area += {n.x * area, n.y * area, n.z * area};
    lanes.patch_first += origin.first_about_centre(first, fan.area);
    lanes.patch_second += origin.second_about_centre(second, first, fan.area);
  }
  TALUS_HD TALUS_INLINE void add_volume(const Fan& fan, const LocalVec3& normal) {
    if (!has_reference) reference = point_at(fan.a, 0), has_reference = true;
    const LocalVec3 origin = rounded(reference);
    const LaneVec3 a = fan.a - origin, b = fan.b - origin, c = fan.c - origin, sum = a + b + c;
    const LocalReal height = dot(point_at(a, 0), normal);        // the same over the plane of the polygon
    const WideLanes pyramid = widened((height / 3) * fan.area);  // to the reference point
    lanes.volume += pyramid;
    // Its centroid lies at 3/4 of the way to the base's.
    lanes.first_moment += Real(0.25) * pyramid * widened(sum);
    const WideLanes share = Real(0.05) * pyramid;
    const auto mean = [](const Lanes& ai, const Lanes& aj, const Lanes& bi, const Lanes& bj, const Lanes& ci,
                         const Lanes& cj, const Lanes& si,
                         const Lanes& sj) { return widened(ai * aj + bi * bj + ci * cj + si * sj); };
    lanes.xx += share * mean(a.x, a.x, b.x, b.x, c.x, c.x, sum.x, sum.x);
    lanes.xy += share * mean(a.x, a.y, b.x, b.y, c.x, c.y, sum.x, sum.y);
    lanes.xz += share * mean(a.x, a.z, b.x, b.z, c.x, c.z, sum.x, sum.z);
    lanes.yy += share * mean(a.y, a.y, b.y, b.y, c.y, c.y, sum.y, sum.y);
    lanes.yz += share * mean(a.y, a.z, b.y, b.z, c.y, c.z, sum.y, sum.z);
    lanes.zz += share * mean(a.z, a.z, b.z, b.z, c.z, c.z, sum.z, sum.z);
  }
};
using VolumeIntegrals = VolumeIntegralsOf<NoPatchSums>;

}  // namespace dem_gpu
