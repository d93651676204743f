// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/welded_surface.h"

namespace dem_gpu {
namespace {

template <class Law>
struct SphereSphereGeometry {
  using Partner = BodyPartner;
  using Damping = OrbitDamping<Law>;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int /*c*/, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const BodyView& bodies = scene.bodies;
    const Vec3 offset = bodies.position[b] - bodies.position[a];
    const Real radius_a = bodies.bounding_radius[a], radius_b = bodies.bounding_radius[b];
    const Real square = norm_squared(offset), reach = radius_a + radius_b;
    if (square >= reach * reach) return false;
    const Real distance = std::sqrt(square);
    const SphereGap gap{distance - radius_b, distance > 0 ? offset / distance : Vec3{0, 0, 1},
                        radius_a * radius_b / reach};
    elastic.curvature = distance > 0 ? 1 / distance : 0;
    return sphere_contact(law, bodies.position[a], radius_a, gap, scene.pair(bodies.material[a], bodies.material[b]),
                          elastic, patch);
  }
};

template <class Law>
struct SphereWallGeometry {
  using Partner = WallPartner;
  using Damping = OrbitDamping<Law>;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int /*c*/, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const WallRecord& wall = scene.walls[b];
    const Real radius = scene.bodies.bounding_radius[a];
    const SurfaceDistance surface = surface_distance(wall, scene.bodies.position[a]);
    if (surface.rim >= 0 && is_held_beside(scene, b, scene.bodies.position[a], surface)) return false;
    if (-surface.depth >= radius) return false;
    if (wall.weld_count > 0 && holder_of_contact(scene, b, scene.bodies.position[a], radius) >= 0) return false;
    return sphere_contact(law, scene.bodies.position[a], radius, {-surface.depth, surface.into_wall, radius},
                          scene.pair(scene.bodies.material[a], wall.material), elastic, patch);
  }

  /// Where two walls share a rim, the nearest point on it counts once, and not at all if the other wall comes nearer.
  TALUS_HD static bool is_held_beside(const ContactScene& scene, int wall, const Vec3& x,
                                      const SurfaceDistance& surface) {
    const int other = scene.walls[wall].rim_neighbour[surface.rim];
    if (other < 0 || !scene.walls[other].is_present) return false;
    const SurfaceDistance beside = surface_distance(scene.walls[other], x);
    return beside.rim < 0 || other < wall;
  }
};

}  // namespace

std::unique_ptr<Pass> make_sphere_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_contacts", ContactKind::sphere_sphere, scene,
                          [](const auto& law) { return SphereSphereGeometry<std::decay_t<decltype(law)>>{law}; });
}

std::unique_ptr<Pass> make_sphere_wall_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_wall_contacts", ContactKind::sphere_wall, scene,
                          [](const auto& law) { return SphereWallGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
