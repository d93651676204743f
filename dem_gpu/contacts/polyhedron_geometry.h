// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/narrow_phase/depth_integrals.h"
#include "dem_gpu/narrow_phase/volume_integrals.h"

namespace dem_gpu {

/// A law's integrals before any overlap, with the sums that friction asks for. `diameter`: equivalent, of the smaller
/// body [m].
template <class Sums = NoPatchSums>
TALUS_HD DepthIntegralsOf<LinearProfile, Sums> empty_integrals(const DepthPotential&, Real /*diameter*/,
                                                               Real /*scale_a*/, Real /*scale_b*/) {
  return {};
}
template <class Sums = NoPatchSums>
TALUS_HD VolumeIntegralsOf<Sums> empty_integrals(const OverlapVolume&, Real /*diameter*/, Real /*scale_a*/,
                                                 Real /*scale_b*/) {
  return {};
}
template <class Sums = NoPatchSums>
TALUS_HD DepthIntegralsOf<HardeningProfile, Sums> empty_integrals(const HardeningDepthPotential& law, Real diameter,
                                                                  Real scale_a, Real scale_b) {
  DepthIntegralsOf<HardeningProfile, Sums> integrals;
  integrals.profile_a.rate = rounded(scale_a / (law.hardening * diameter));
  integrals.profile_b.rate = rounded(scale_b / (law.hardening * diameter));
  return integrals;
}

TALUS_HD inline Real smaller_diameter(const ShapeView& shapes, int shape_a, int shape_b, const Pose& a, const Pose& b) {
  return std::min(a.scale * shapes.shapes[shape_a].equivalent_diameter,
                  b.scale * shapes.shapes[shape_b].equivalent_diameter);
}

TALUS_HD inline bool balls_meet(const Vec3& centre_a, Real radius_a, const Vec3& centre_b, Real radius_b) {
  const Real reach = radius_a + radius_b;
  return norm_squared(centre_a - centre_b) < reach * reach;
}

/// Sums a law's integrals over all pairs of parts of two polyhedral bodies. `separating`: the contact's cache, one
/// entry per pair of parts. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_bodies(const ShapeView& shapes, int shape_a, int shape_b, const Pose& a, const Pose& b,
                               SeparatingPlane* separating, Integrals& integrals) {
  const ShapeRange& range_a = shapes.shapes[shape_a];
  const ShapeRange& range_b = shapes.shapes[shape_b];
  const FrameChange b_to_a = frame_change(a, b), a_to_b = frame_change(b, a);
  bool is_whole = true;
  for (int j = 0; j < range_b.part_count; ++j) {
    const PartRange& ball_b = shapes.parts[range_b.first_part + j];
    const Vec3 centre_b = b_to_a.point(ball_b.centre);
    const Real radius_b = b_to_a.scale * ball_b.radius;
    if (!balls_meet(centre_b, radius_b, Vec3{}, range_a.bounding_radius)) continue;
    for (int i = 0; i < range_a.part_count; ++i) {
      const PartRange& ball_a = shapes.parts[range_a.first_part + i];
      if (!balls_meet(centre_b, radius_b, ball_a.centre, ball_a.radius)) continue;
      const OverlapStatus status =
          integrate_overlap(part_view(shapes, range_a.first_part + i), part_view(shapes, range_b.first_part + j),
                            b_to_a, a_to_b, separating[i * range_b.part_count + j], integrals);
      if (status == OverlapStatus::polygon_truncated) is_whole = false;
    }
  }
  return is_whole;
}

/// Polyhedron against polyhedron, or against a convex volume object.
template <class Law, class PartnerKind>
struct PolyhedronGeometry {
  using Partner = PartnerKind;
  using Damping = PointDamping;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const Pose pose_a = scene.pose(a);
    Pose pose_b;
    int shape_b = 0;
    if constexpr (Partner::kIsWall) {
      const WallRecord& wall = scene.walls[b];
      pose_b = {rotation_matrix(wall.orientation), wall.point, 1};
      shape_b = wall.shape;
    } else {
      const Real reach = scene.bodies.bounding_radius[a] + scene.bodies.bounding_radius[b];
      if (norm_squared(scene.bodies.position[b] - pose_a.position) >= reach * reach) return false;
      pose_b = scene.pose(b);
      shape_b = scene.bodies.shape[b];
    }
    const int shape_a = scene.bodies.shape[a];
    auto integrals = empty_integrals<PatchSumsFor<Patch>>(
        law, smaller_diameter(scene.shapes, shape_a, shape_b, pose_a, pose_b), pose_a.scale, pose_b.scale);
    if constexpr (Partner::kIsWall && !std::is_same_v<Law, OverlapVolume>) integrals.has_seams = true;
    const bool is_whole = integrate_bodies(scene.shapes, shape_a, shape_b, pose_a, pose_b,
                                           scene.contacts.separating + scene.contacts.cache_begin[c], integrals);
    if (!is_whole) scene.contacts.is_truncated[c] = 1;
    if (!integrals.to_contact(law, pose_a, elastic)) return false;
    if constexpr (integrals.kHasPatch) patch = integrals.to_patch(law, pose_a, elastic);
    return true;
  }
};

}  // namespace dem_gpu
