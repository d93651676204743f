// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/wall_geometry.h"
#include "dem_gpu/walls/disc_integrals.h"
#include "dem_gpu/walls/round_integrals.h"

namespace dem_gpu {
namespace {

/// Polyhedron against an analytic wall.
template <class Law>
struct PolyhedronWallGeometry {
  using Partner = WallPartner;
  using Damping = PointDamping;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const WallRecord& wall = scene.walls[b];
    const Pose pose = scene.pose(a);
    if (wall_field(wall, pose.position).depth + scene.bodies.bounding_radius[a] <= 0) return false;
    const ShapeRange& shape = scene.shapes.shapes[scene.bodies.shape[a]];
    auto integrals = empty_wall_integrals<WallPatchSumsFor<Patch>>(law, pose.scale * shape.equivalent_diameter);
    for (int p = 0; p < shape.part_count; ++p)
      if (!integrate_part(part_view(scene.shapes, shape.first_part + p), pose, wall, integrals))
        scene.contacts.is_truncated[c] = 1;
    return wall_contact(law, integrals, pose.position, elastic, patch);
  }

  template <class Integrals>
  TALUS_HD static bool integrate_part(const PartView& part, const Pose& pose, const WallRecord& wall,
                                      Integrals& integrals) {
    if (wall.kind == WallKind::disc)
      return integrate_part_in_disc({part, {pose.rotation, {}, pose.scale}}, pose.position, wall, integrals);
    if (wall.kind != WallKind::plane) return integrate_part_on_round_wall(part, pose, wall, integrals);
    integrate_part_in_plane(part, pose, wall, integrals);
    return true;
  }
};

}  // namespace

std::unique_ptr<Pass> make_polyhedron_wall_contacts_pass(const Scene& scene) {
  return make_contact_pass("polyhedron_wall_contacts", ContactKind::polyhedron_wall, scene, scene.polyhedral_law,
                           polyhedron_friction(scene),
                           [](const auto& law) { return PolyhedronWallGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
