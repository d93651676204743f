// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/start/lone_pair.h"

#include <utility>

#include "dem_gpu/core/parallel.h"
#include "dem_gpu/start/model_builder.h"
#include "dem_gpu/step_builder.h"
#include "dem_gpu/walls/hidden_faces.h"

namespace dem_gpu {
namespace {

/// The wall of a pair as it meets bodies among all others.
Wall wall_alone(const Model& whole, int index) {
  Wall wall = whole.scene.walls[index];
  if (auto* object = std::get_if<VolumeObject>(&wall.geometry))
    object->part = welded_part(whole.scene, static_cast<std::size_t>(index));
  auto* mesh = std::get_if<MeshObject>(&wall.geometry);
  if (mesh && mesh->depth == 0) mesh->depth = max_of(whole.bodies.bounding_radius, Real(0));
  return wall;
}

/// Body 0 is a; body 1, or the wall, is b.
Scene scene_of(const Model& whole, const StartPair& pair) {
  const Scene& scene = whole.scene;
  Scene alone;
  alone.name = scene.name;
  alone.gravity = {};
  alone.materials = scene.materials;
  const std::size_t n = scene.materials.size();
  alone.contact.assign(n, std::vector<ContactProperties>(n, {1, 0}));
  alone.shapes = scene.shapes;
  alone.polyhedral_law = scene.polyhedral_law;
  alone.sphere_law = scene.sphere_law;
  alone.friction = std::nullopt;
  alone.energy_ledger = false;
  alone.run.time_step = whole.time_step;
  const auto add = [&](const Body& body, const Vec3& moved_by) {
    Body copy = body;
    copy.position += moved_by;
    copy.velocity = copy.angular_velocity = {};
    copy.is_fixed = false;
    alone.bodies.push_back(copy);
  };
  add(scene.bodies[pair.a], {});
  if (pair.has_wall())
    alone.walls.push_back(wall_alone(whole, pair.b));
  else
    add(scene.bodies[pair.b], pair.shift_b);
  return alone;
}

/// The whole scene's, the wall's own object, if it is one, taken for the first.
PreparedShapes shapes_of(const Model& whole, const StartPair& pair) {
  PreparedShapes shapes = whole.shapes;
  if (!pair.has_wall()) return shapes;
  for (int w = 0; w < pair.b; ++w)
    shapes.first_object += std::holds_alternative<VolumeObject>(whole.scene.walls[w].geometry);
  return shapes;
}

}  // namespace

LonePair::LonePair(const Model& whole, const StartPair& pair)
    : model_(make_model(scene_of(whole, pair), shapes_of(whole, pair), at_start_)),
      passes_(build_step(model_.scene)),
      place_(model_.scene.bodies[0].position) {}

Vec3 LonePair::force_at(const Vec3& shift) {
  BodyColumns moved = at_start_;
  moved.position[0] = place_ + shift;
  State state = start_state(model_, std::move(moved));
  find_forces(passes_, model_, state);
  Vec3 force;
  const auto keys = to_host(state.contacts.key);
  const auto depth = to_host(state.contacts.depth);
  const auto forces = to_host(state.contacts.force);
  for (std::size_t c = 0; c < keys.size(); ++c)
    if (depth[c] > 0) force += (key_body_a(keys[c]) == 0 ? Real(1) : Real(-1)) * forces[c];
  return force;
}

}  // namespace dem_gpu
