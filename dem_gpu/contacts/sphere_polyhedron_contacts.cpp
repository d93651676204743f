// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

/// Sphere against a polyhedral body or a volume object: one contact, at the nearest point of the whole body, so that a
/// sphere rolling over the seam of two parts meets one contact, not two.
template <class Law, class PartnerKind>
struct SpherePolyhedronGeometry {
  using Partner = PartnerKind;
  using Damping = OrbitDamping<Law>;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int /*c*/, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const Vec3 centre = scene.bodies.position[a];
    const Real radius = scene.bodies.bounding_radius[a];
    PartDistance nearest;
    const PairProperties* pair = nullptr;
    if constexpr (Partner::kIsWall) {
      const WallRecord& wall = scene.walls[b];
      nearest = distance_to_body(scene.shapes, wall.shape, {rotation_matrix(wall.orientation), wall.point, 1}, centre,
                                 radius);
      if (nearest.distance >= radius) return false;
      if (wall.weld_count > 0 && holder_of_contact(scene, b, centre, radius) >= 0) return false;
      pair = &scene.pair(scene.bodies.material[a], wall.material);
    } else {
      const Real reach = radius + scene.bodies.bounding_radius[b];
      if (norm_squared(scene.bodies.position[b] - centre) >= reach * reach) return false;
      nearest = distance_to_body(scene.shapes, scene.bodies.shape[b], scene.pose(b), centre, radius);
      pair = &scene.pair(scene.bodies.material[a], scene.bodies.material[b]);
    }
    return sphere_contact(law, centre, radius, {nearest.distance, -nearest.outward, radius}, *pair, elastic, patch);
  }
};

}  // namespace

std::unique_ptr<Pass> make_sphere_polyhedron_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_polyhedron_contacts", ContactKind::sphere_polyhedron, scene, [](const auto& law) {
    return SpherePolyhedronGeometry<std::decay_t<decltype(law)>, BodyPartner>{law};
  });
}

std::unique_ptr<Pass> make_sphere_object_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_object_contacts", ContactKind::sphere_object, scene, [](const auto& law) {
    return SpherePolyhedronGeometry<std::decay_t<decltype(law)>, WallPartner>{law};
  });
}

}  // namespace dem_gpu
