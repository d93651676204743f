// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/narrow_phase/depth_integrals.h"
#include "dem_gpu/narrow_phase/volume_integrals.h"

namespace dem_gpu {

template <class Law>
struct IntegralsOf;
template <>
struct IntegralsOf<DepthPotential> {
  using Type = DepthIntegrals;
};
template <>
struct IntegralsOf<OverlapVolume> {
  using Type = VolumeIntegrals;
};

/// Sums a law's integrals over all pairs of parts of two polyhedral bodies. `separating`: the contact's cache, one
/// entry per pair of parts. False if a polygon was truncated.
template <class Integrals>
TALUS_HD bool integrate_bodies(const ShapeView& shapes, int shape_a, int shape_b, const Pose& a, const Pose& b,
                               SeparatingPlane* separating, Integrals& integrals) {
  const ShapeRange& range_a = shapes.shapes[shape_a];
  const ShapeRange& range_b = shapes.shapes[shape_b];
  const FrameChange b_to_a = frame_change(a, b), a_to_b = frame_change(b, a);
  bool is_whole = true;
  for (int i = 0; i < range_a.part_count; ++i) {
    const PartView part_a = part_view(shapes, range_a.first_part + i);
    for (int j = 0; j < range_b.part_count; ++j) {
      const PartView part_b = part_view(shapes, range_b.first_part + j);
      const Real reach = part_a.range.radius + b_to_a.scale * part_b.range.radius;
      if (norm_squared(b_to_a.point(part_b.range.centre) - part_a.range.centre) >= reach * reach) continue;
      const OverlapStatus status =
          integrate_overlap(part_a, part_b, b_to_a, a_to_b, separating[i * range_b.part_count + j], integrals);
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

  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic, NoPatch&) const {
    const Pose pose_a = scene.pose(a);
    typename IntegralsOf<Law>::Type integrals;
    SeparatingPlane* separating = scene.contacts.separating + scene.contacts.cache_begin[c];
    bool is_whole = true;
    if constexpr (Partner::kIsWall) {
      const WallRecord& wall = scene.walls[b];
      const Pose pose_b{rotation_matrix(wall.orientation), wall.point, 1};
      is_whole =
          integrate_bodies(scene.shapes, scene.bodies.shape[a], wall.shape, pose_a, pose_b, separating, integrals);
    } else {
      const Real reach = scene.bodies.bounding_radius[a] + scene.bodies.bounding_radius[b];
      if (norm_squared(scene.bodies.position[b] - pose_a.position) >= reach * reach) return false;
      is_whole = integrate_bodies(scene.shapes, scene.bodies.shape[a], scene.bodies.shape[b], pose_a, scene.pose(b),
                                  separating, integrals);
    }
    if (!is_whole) scene.contacts.is_truncated[c] = 1;
    return integrals.to_contact(law, pose_a, elastic);
  }
};

}  // namespace dem_gpu
