// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/wall_geometry.h"
#include "dem_gpu/meshes/mesh_distance.h"
#include "dem_gpu/meshes/mesh_integrals.h"

namespace dem_gpu {
namespace {

/// Polyhedron against a triangle mesh: the sum over the facets of its list.
template <class Law>
struct PolyhedronMeshGeometry {
  using Partner = WallPartner;
  using Damping = PointDamping;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const int first = scene.contacts.facet_begin[c], last = scene.contacts.facet_begin[c + 1];
    if (first == last) return false;
    const WallRecord& wall = scene.walls[b];
    const Mat3 axes = rotation_matrix(wall.orientation);
    const Pose pose = scene.pose(a);
    const Vec3 origin = transpose_times(axes, pose.position - wall.point);
    const FrameChange to_mesh{transpose_times(axes, pose.rotation), {}, pose.scale};
    const ShapeRange& shape = scene.shapes.shapes[scene.bodies.shape[a]];
    auto integrals = empty_wall_integrals<WallPatchSumsFor<Patch>>(law, pose.scale * shape.equivalent_diameter);
    for (int p = 0; p < shape.part_count; ++p) {
      const PartView part = part_view(scene.shapes, shape.first_part + p);
      const PlacedPart body(part, to_mesh);
      for (int k = first; k < last; ++k)
        if (!integrate_part_in_cell(body, scene.meshes, scene.meshes.facets[scene.contacts.facet[k]], origin,
                                    integrals))
          scene.contacts.is_truncated[c] = 1;
    }
    integrals.turn(axes);
    return wall_contact(law, integrals, pose.position, elastic, patch);
  }
};

/// Sphere against a triangle mesh: the sum over the places where it touches.
template <class Law>
struct SphereMeshGeometry {
  using Partner = WallPartner;
  using Damping = OrbitDamping<Law>;
  Law law;

  template <class Patch>
  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic, Patch& patch) const {
    const WallRecord& wall = scene.walls[b];
    const Vec3 centre = scene.bodies.position[a];
    const Vec3 x = rotate_back(wall.orientation, centre - wall.point);
    const Real radius = scene.bodies.bounding_radius[a];
    MeshTouches touches;
    for (int k = scene.contacts.facet_begin[c]; k < scene.contacts.facet_begin[c + 1]; ++k)
      add_touch(scene.meshes, scene.contacts.facet[k], x, radius, touches);
    if (touches.count == 0) return false;
    return sum_touches(visible(touches), centre, radius, scene.pair(scene.bodies.material[a], wall.material),
                       rotation_matrix(wall.orientation), elastic, patch);
  }

  /// Outside the solid: what can be seen from the centre, so no back sides. Inside: the shallowest alone.
  TALUS_HD static MeshTouches visible(const MeshTouches& touches) {
    int nearest = 0;
    for (int i = 1; i < touches.count; ++i)
      if (std::abs(touches.touch[i].distance) < std::abs(touches.touch[nearest].distance)) nearest = i;
    MeshTouches seen;
    if (touches.touch[nearest].distance < 0) {
      seen.add(touches.touch[nearest]);
      return seen;
    }
    for (int i = 0; i < touches.count; ++i)
      if (touches.touch[i].distance >= 0) seen.add(touches.touch[i]);
    return seen;
  }

  /// The normal is that of the repulsion.
  template <class Patch>
  TALUS_HD bool sum_touches(const MeshTouches& touches, const Vec3& centre, Real radius, const PairProperties& pair,
                            const Mat3& axes, ElasticContact& elastic, Patch& patch) const {
    ElasticContact single[MeshTouches::kMost];
    Real share[MeshTouches::kMost];
    Real total = 0;
    Vec3 pressed;
    for (int i = 0; i < touches.count; ++i) {
      const MeshTouch& touch = touches.touch[i];
      share[i] = 1;
      for (int k = 0; k < i; ++k)
        if (share[k] > 0) share[i] *= share_beside(touches.touch[k], touch);
      if (!(share[i] > 0)) continue;
      const SphereGap gap{touch.distance, axes * touch.direction, radius};
      if (!sphere_contact(law, centre, radius, gap, pair, single[i], patch)) continue;
      const Real magnitude = share[i] * (single[i].adhesion - dot(single[i].force, single[i].normal));
      elastic.force += share[i] * single[i].force;
      elastic.energy += share[i] * single[i].energy;
      elastic.point += magnitude * (single[i].point - centre);
      elastic.depth = std::max(elastic.depth, single[i].depth);
      pressed += magnitude * single[i].normal;
      total += magnitude;
    }
    if (!(norm(pressed) > 0)) return false;
    elastic.normal = unit_or(pressed, {0, 0, 1});
    elastic.point = centre + elastic.point / total;
    for (int i = 0; i < touches.count; ++i) {
      if (!(share[i] > 0)) continue;
      const Real along = dot(single[i].normal, elastic.normal);
      elastic.stiffness += share[i] * along * along * single[i].stiffness;
      elastic.adhesion += share[i] * along * single[i].adhesion;
    }
    return elastic.stiffness > 0;
  }
};

}  // namespace

std::unique_ptr<Pass> make_polyhedron_mesh_contacts_pass(const Scene& scene) {
  return make_contact_pass("polyhedron_mesh_contacts", ContactKind::polyhedron_mesh, scene, scene.polyhedral_law,
                           polyhedron_friction(scene),
                           [](const auto& law) { return PolyhedronMeshGeometry<std::decay_t<decltype(law)>>{law}; });
}

std::unique_ptr<Pass> make_sphere_mesh_contacts_pass(const Scene& scene) {
  return make_sphere_pass("sphere_mesh_contacts", ContactKind::sphere_mesh, scene,
                          [](const auto& law) { return SphereMeshGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
