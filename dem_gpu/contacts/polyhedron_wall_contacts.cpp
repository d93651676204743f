// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {
namespace {

/// A law's integrals before any overlap. `diameter`: equivalent, of the body [m].
template <class Sums, class Law>
TALUS_HD WallIntegralsOf<LinearProfile, Sums> empty_wall_integrals(const Law&, Real /*diameter*/) {
  return {};
}
template <class Sums>
TALUS_HD WallIntegralsOf<HardeningProfile, Sums> empty_wall_integrals(const HardeningDepthPotential& law,
                                                                      Real diameter) {
  WallIntegralsOf<HardeningProfile, Sums> integrals;
  integrals.profile.rate = 1 / (law.hardening * diameter);
  return integrals;
}

/// Polyhedron against an analytic wall.
template <class Law>
struct PolyhedronWallGeometry {
  using Partner = WallPartner;
  using Damping = PointDamping;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int /*c*/, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const WallRecord& wall = scene.walls[b];
    const Pose pose = scene.pose(a);
    if (wall_field(wall, pose.position).depth + scene.bodies.bounding_radius[a] <= 0) return false;
    const ShapeRange& shape = scene.shapes.shapes[scene.bodies.shape[a]];
    auto integrals = empty_wall_integrals<WallPatchSumsFor<Patch>>(law, pose.scale * shape.equivalent_diameter);
    if constexpr (integrals.kHasPatch) integrals.patch.wall = &wall, integrals.patch.centre = pose.position;
    for (int p = 0; p < shape.part_count; ++p)
      integrate_part_in_wall(part_view(scene.shapes, shape.first_part + p), pose, wall, integrals);
    // A flat face meets a wall as stiffly as another flat face. With the volume law too: the integral of the depth over
    // the surface inside a flat wall is the overlap volume.
    if (!integrals.to_contact(law.stiffness_per_area(), pose.position, elastic)) return false;
    if constexpr (integrals.kHasPatch) patch = integrals.to_patch(law.stiffness_per_area());
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
