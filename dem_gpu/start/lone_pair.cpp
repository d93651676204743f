// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/start/lone_pair.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

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

/// Row of a wall among the shapes of the whole scene; nothing if it is no volume object.
std::optional<int> object_row(const Model& whole, int wall) {
  const auto is_object = [](const Wall& of) { return std::holds_alternative<VolumeObject>(of.geometry); };
  const std::vector<Wall>& walls = whole.scene.walls;
  if (!is_object(walls[wall])) return std::nullopt;
  return whole.shapes.first_object + static_cast<int>(std::count_if(walls.begin(), walls.begin() + wall, is_object));
}

/// Body 0 is a; body 1, or the wall, is b. Each body has a shape of its own.
Scene scene_of(const Model& whole, const StartPair& pair) {
  const Scene& scene = whole.scene;
  Scene alone;
  alone.name = scene.name;
  alone.gravity = {};
  alone.materials = scene.materials;
  const std::size_t n = scene.materials.size();
  alone.contact.assign(n, std::vector<ContactProperties>(n, {1, 0}));
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
    copy.shape = static_cast<int>(alone.shapes.size());
    alone.shapes.push_back(scene.shapes[body.shape]);
    alone.bodies.push_back(copy);
  };
  add(scene.bodies[pair.a], {});
  if (pair.has_wall())
    alone.walls.push_back(wall_alone(whole, pair.b));
  else
    add(scene.bodies[pair.b], pair.shift_b);
  return alone;
}

/// Of the bodies of scene_of(), and of the wall if it is an object.
PreparedShapes shapes_of(const Model& whole, const HostShapeColumns& columns, const StartPair& pair) {
  std::vector<int> rows{whole.scene.bodies[pair.a].shape};
  if (!pair.has_wall()) rows.push_back(whole.scene.bodies[pair.b].shape);
  PreparedShapes shapes;
  for (const int row : rows) shapes.least_width.push_back(whole.shapes.least_width[row]);
  shapes.first_object = static_cast<int>(rows.size());
  if (pair.has_wall())
    if (const std::optional<int> row = object_row(whole, pair.b)) rows.push_back(*row);
  shapes.columns = to_device(chosen_shapes(columns, rows));
  return shapes;
}

}  // namespace

LonePair::LonePair(const Model& whole, const HostShapeColumns& shapes, const StartPair& pair)
    : model_(make_model(scene_of(whole, pair), shapes_of(whole, shapes, pair), at_start_)),
      passes_(build_step(model_.scene)),
      place_(model_.scene.bodies[0].position) {}

Vec3 LonePair::force_at(const Vec3& shift) {
  BodyColumns moved = at_start_;
  moved.position[0] = place_ + shift;
  State state = start_state(model_, std::move(moved));
  find_forces(passes_, model_, state);
  Vec3 force;
  const auto keys = to_host(state.contacts.key);
  const auto rows = to_host(state.contacts.row);
  for (std::size_t c = 0; c < keys.size(); ++c)
    if (rows[c].depth > 0) force += (key_body_a(keys[c]) == 0 ? Real(1) : Real(-1)) * rows[c].force;
  return force;
}

}  // namespace dem_gpu
