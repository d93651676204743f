// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <type_traits>

#include "dem_gpu/contacts/body_overlap.h"
#include "dem_gpu/contacts/contact_scene.h"
#include "dem_gpu/contacts/normal_damping.h"

namespace dem_gpu {

/// Polyhedron against polyhedron, or against a convex volume object.
template <class Law, class PartnerKind>
struct PolyhedronGeometry {
  using Partner = PartnerKind;
  using Damping = PointDamping;
  static constexpr bool kMayWait = !Partner::kIsWall;
  Law law;

  /// Known from an earlier step to be apart still: neither can have come so far since.
  TALUS_HD static bool waits(const ContactScene& scene, int c, int a, int b) {
    return scene.contacts.apart_until &&
           scene.contacts.apart_until[c] > scene.bodies.travel[a] + scene.bodies.travel[b];
  }
  TALUS_HD static void wait(const ContactScene& scene, int c, int a, int b, Real distance) {
    if (scene.contacts.apart_until)
      scene.contacts.apart_until[c] = scene.bodies.travel[a] + scene.bodies.travel[b] + distance;
  }

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
      const Real square = norm_squared(scene.bodies.position[b] - scene.bodies.position[a]);
      if (square >= reach * reach) {
        wait(scene, c, a, b, std::sqrt(square) * (1 - kCoplanarity) - reach);
        return false;
      }
      pose_b = scene.pose(b);
      shape_b = scene.bodies.shape[b];
    }
    const int shape_a = scene.bodies.shape[a];
    auto integrals = empty_integrals<PatchSumsFor<Patch>>(
        law, smaller_diameter(scene.shapes, shape_a, shape_b, pose_a, pose_b), pose_a.scale, pose_b.scale);
    if constexpr (Partner::kIsWall && !std::is_same_v<Law, OverlapVolume>) integrals.has_seams = true;
    const PairOutcome outcome = integrate_bodies(scene.shapes, shape_a, shape_b, pose_a, pose_b,
                                                 scene.contacts.separating + scene.contacts.cache_begin[c], integrals);
    if (!outcome.is_whole) scene.contacts.is_truncated[c] = 1;
    if (!integrals.to_contact(law, pose_a, elastic)) {
      if constexpr (kMayWait)
        if (scene.contacts.apart_until) {
          // Where no known face plane is between them, another one, or an edge of each, may be.
          const Real distance = outcome.distance > 0
                                    ? outcome.distance
                                    : distance_of_bodies(scene.shapes, shape_a, shape_b, pose_a, pose_b);
          wait(scene, c, a, b, distance);
        }
      return false;
    }
    if constexpr (integrals.kHasPatch) patch = integrals.to_patch(law, pose_a, elastic);
    return true;
  }
};

}  // namespace dem_gpu
