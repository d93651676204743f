// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/contacts/sphere_geometry.h"
#include "dem_gpu/contacts/wall_stiffness.h"
#include "dem_gpu/meshes/mesh_distance.h"
#include "dem_gpu/meshes/mesh_integrals.h"

namespace dem_gpu {
namespace {

/// Polyhedron against a triangle mesh: the sum over the facets of its list.
template <class Law>
struct PolyhedronMeshGeometry {
  using Partner = WallPartner;
  Law law;

  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic) const {
    const int first = scene.contacts.facet_begin[c], last = scene.contacts.facet_begin[c + 1];
    if (first == last) return false;
    const WallRecord& wall = scene.walls[b];
    const Mat3 axes = rotation_matrix(wall.orientation);
    const Pose pose = scene.pose(a);
    const Vec3 origin = transpose_times(axes, pose.position - wall.point);
    const FrameChange to_mesh{transpose_times(axes, pose.rotation), {}, pose.scale};
    const ShapeRange& shape = scene.shapes.shapes[scene.bodies.shape[a]];
    WallIntegrals integrals;
    for (int p = 0; p < shape.part_count; ++p) {
      const PartView part = part_view(scene.shapes, shape.first_part + p);
      const PlacedPart body(part, to_mesh);
      for (int k = first; k < last; ++k)
        if (!integrate_part_in_cell(body, scene.meshes, scene.meshes.facets[scene.contacts.facet[k]], origin,
                                    integrals))
          scene.contacts.is_truncated[c] = 1;
    }
    integrals.turn(axes);
    return integrals.to_contact(wall_stiffness(law), pose.position, elastic);
  }
};

/// Sphere against a triangle mesh: the sum over the places where it touches.
template <class Law>
struct SphereMeshGeometry {
  using Partner = WallPartner;
  Law law;

  TALUS_HD bool find(const ContactScene& scene, int c, int a, int b, ElasticContact& elastic) const {
    const WallRecord& wall = scene.walls[b];
    const Vec3 centre = scene.bodies.position[a];
    const Vec3 x = rotate_back(wall.orientation, centre - wall.point);
    const Real radius = scene.bodies.bounding_radius[a];
    MeshTouches touches;
    for (int k = scene.contacts.facet_begin[c]; k < scene.contacts.facet_begin[c + 1]; ++k)
      add_touch(scene.meshes, scene.contacts.facet[k], x, radius, touches);
    if (touches.count == 0) return false;
    const Real modulus = scene.pair(scene.bodies.material[a], wall.material).effective_modulus;
    return sum_touches(visible(touches), centre, radius, modulus, rotation_matrix(wall.orientation), elastic);
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

  TALUS_HD bool sum_touches(const MeshTouches& touches, const Vec3& centre, Real radius, Real modulus, const Mat3& axes,
                            ElasticContact& elastic) const {
    ElasticContact single[MeshTouches::kMost];
    Real share[MeshTouches::kMost];
    Real total = 0;
    for (int i = 0; i < touches.count; ++i) {
      const MeshTouch& touch = touches.touch[i];
      share[i] = 1;
      for (int k = 0; k < i; ++k)
        if (share[k] > 0) share[i] *= share_beside(touches.touch[k], touch);
      if (!(share[i] > 0)) continue;
      if (!sphere_contact(law, centre, radius, {touch.distance, axes * touch.direction, radius}, modulus, single[i]))
        continue;
      const Real magnitude = share[i] * norm(single[i].force);
      elastic.force += share[i] * single[i].force;
      elastic.point += magnitude * (single[i].point - centre);
      elastic.depth = std::max(elastic.depth, single[i].depth);
      total += magnitude;
    }
    if (!(total > 0) || !set_normal(elastic)) return false;
    elastic.point = centre + elastic.point / total;
    for (int i = 0; i < touches.count; ++i) {
      if (!(share[i] > 0)) continue;
      const Real along = dot(single[i].normal, elastic.normal);
      elastic.stiffness += share[i] * along * along * single[i].stiffness;
    }
    return elastic.stiffness > 0;
  }
};

}  // namespace

std::unique_ptr<Pass> make_polyhedron_mesh_contacts_pass(const Scene& scene) {
  return make_contact_pass("polyhedron_mesh_contacts", ContactKind::polyhedron_mesh, scene, scene.polyhedral_law,
                           [](const auto& law) { return PolyhedronMeshGeometry<std::decay_t<decltype(law)>>{law}; });
}

std::unique_ptr<Pass> make_sphere_mesh_contacts_pass(const Scene& scene) {
  return make_contact_pass("sphere_mesh_contacts", ContactKind::sphere_mesh, scene, scene.sphere_law,
                           [](const auto& law) { return SphereMeshGeometry<std::decay_t<decltype(law)>>{law}; });
}

}  // namespace dem_gpu
