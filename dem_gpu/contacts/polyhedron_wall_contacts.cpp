// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/wall_stiffness.h"
#include "dem_gpu/walls/disc_integrals.h"

namespace dem_gpu {
namespace {

/// Polyhedron against an analytic wall.
template <class Law>
struct PolyhedronWallGeometry {
  using Partner = WallPartner;
  Law law;

  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic) const {
    const WallRecord& wall = scene.walls[b];
    const Pose pose = scene.pose(a);
    if (wall_field(wall, pose.position).depth + scene.bodies.bounding_radius[a] <= 0) return false;
    WallIntegrals integrals;
    const ShapeRange& shape = scene.shapes.shapes[scene.bodies.shape[a]];
    for (int p = 0; p < shape.part_count; ++p)
      if (!integrate_part(part_view(scene.shapes, shape.first_part + p), pose, wall, integrals))
        scene.contacts.is_truncated[c] = 1;
    return integrals.to_contact(wall_stiffness(law), pose.position, elastic);
  }

  TALUS_HD static bool integrate_part(const PartView& part, const Pose& pose, const WallRecord& wall,
                                      WallIntegrals& integrals) {
    if (wall.kind == WallKind::disc)
      return integrate_part_in_disc({part, {pose.rotation, {}, pose.scale}}, pose.position, wall, integrals);
    if (wall.solid_within) return integrate_part_outside(part, pose, wall, integrals);
    integrate_part_in_wall(part, pose, wall, integrals);
    return true;
  }
};

}  // namespace

std::unique_ptr<Pass> make_polyhedron_wall_contacts_pass(const Scene& scene) {
  return make_contact_pass("polyhedron_wall_contacts", ContactKind::polyhedron_wall, scene, scene.polyhedral_law,
                           [](const auto& law) { return PolyhedronWallGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
