// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/step_builder.h"

#include <algorithm>

#include "dem_gpu/broad_phase/neighbour_list.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/motion/motion_passes.h"
#include "dem_gpu/walls/hidden_faces.h"
#include "dem_gpu/walls/wall_motion.h"

namespace dem_gpu {
namespace {

bool is_sphere(const Scene& scene, const Body& body) {
  return std::holds_alternative<SphereShape>(scene.shapes[body.shape].geometry);
}

bool is_object(const Wall& wall) { return std::holds_alternative<VolumeObject>(wall.geometry); }

bool is_mesh(const Wall& wall) { return std::holds_alternative<MeshObject>(wall.geometry); }

bool is_analytic(const Wall& wall) { return !is_object(wall) && !is_mesh(wall); }

bool has_seams(const Scene& scene) {
  const auto welds = welded_walls(scene);
  return std::any_of(welds.begin(), welds.end(), [](const auto& list) { return !list.empty(); });
}

bool moves(const Wall& wall) { return wall.removed_at || is_moving(wall.motion); }

}  // namespace

std::vector<std::unique_ptr<Pass>> build_step(const Scene& scene) {
  const auto sphere_count =
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) { return is_sphere(scene, body); });
  const auto polyhedron_count = static_cast<std::ptrdiff_t>(scene.bodies.size()) - sphere_count;
  const bool has_objects = std::any_of(scene.walls.begin(), scene.walls.end(), is_object);
  const bool has_meshes = std::any_of(scene.walls.begin(), scene.walls.end(), is_mesh);
  const bool has_walls = std::any_of(scene.walls.begin(), scene.walls.end(), is_analytic);

  std::vector<std::unique_ptr<Pass>> passes;
  const auto add = [&](bool is_needed, auto make, const auto&... arguments) {
    if (is_needed) passes.push_back(make(arguments...));
  };
  add(true, make_advance_bodies_pass);
  add(std::any_of(scene.walls.begin(), scene.walls.end(), moves), make_advance_walls_pass);
  add(true, make_neighbour_list_pass);
  add(polyhedron_count > 1, make_polyhedron_contacts_pass, scene);
  add(polyhedron_count > 0 && has_walls, make_polyhedron_wall_contacts_pass, scene);
  add(polyhedron_count > 0 && has_objects, make_polyhedron_object_contacts_pass, scene);
  add(polyhedron_count > 0 && has_meshes, make_polyhedron_mesh_contacts_pass, scene);
  add(sphere_count > 0 && has_objects && has_seams(scene), make_seam_crossings_pass);
  add(sphere_count > 1, make_sphere_contacts_pass, scene);
  add(sphere_count > 0 && polyhedron_count > 0, make_sphere_polyhedron_contacts_pass, scene);
  add(sphere_count > 0 && has_walls, make_sphere_wall_contacts_pass, scene);
  add(sphere_count > 0 && has_objects, make_sphere_object_contacts_pass, scene);
  add(sphere_count > 0 && has_meshes, make_sphere_mesh_contacts_pass, scene);
  add(true, make_gather_forces_pass);
  add(scene.outflow.has_value(), make_outflow_pass);
  return passes;
}

}  // namespace dem_gpu
