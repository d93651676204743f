// SPDX-License-Identifier: Apache-2.0
#include "workflows/idle_settings.h"

#include <algorithm>

namespace workflows {
namespace {

/// Materials of no body and no wall, motions of no wall.
std::vector<std::string> idle_sections(const SceneDescription& description, const dem_gpu::Scene& scene) {
  std::vector<char> is_used(scene.materials.size(), 0);
  for (const dem_gpu::Body& body : scene.bodies) is_used[static_cast<std::size_t>(body.material)] = 1;
  for (const dem_gpu::Wall& wall : scene.walls) is_used[static_cast<std::size_t>(wall.material)] = 1;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (!is_used[i]) {
      const std::string& name = scene.materials[i].name;
      lines.push_back(description.places.at("material '" + name + "'") + ": no fill, chain or wall is of material \"" +
                      name + "\": it has no effect");
    }
  for (const std::string& motion : description.motions) {
    const auto moves_by_it = [&](const dem_gpu::Wall& wall) { return wall.group == motion; };
    if (std::none_of(scene.walls.begin(), scene.walls.end(), moves_by_it))
      lines.push_back(description.places.at("motion '" + motion + "'") + ": no wall has motion = \"" + motion +
                      "\": it moves nothing");
  }
  return lines;
}

}  // namespace

std::vector<std::string> idle_settings(const SceneDescription& description, const dem_gpu::Scene& scene) {
  const auto is_sphere = [&](const dem_gpu::Body& body) {
    return std::holds_alternative<dem_gpu::SphereShape>(scene.shapes[static_cast<std::size_t>(body.shape)].geometry);
  };
  const bool has_spheres = std::any_of(scene.bodies.begin(), scene.bodies.end(), is_sphere);
  const bool has_polyhedra = !std::all_of(scene.bodies.begin(), scene.bodies.end(), is_sphere);
  const StiffnessChoice& stiffness = description.stiffness;
  const dem_gpu::DepthPotential* depth = dem_gpu::depth_potential(scene.polyhedral_law);
  const bool has_cap = depth && depth->depth_cap != dem_gpu::DepthPotential{}.depth_cap;
  const std::string law = description.places.at("contact law") + ": contact_law: ",
                    contact = description.file.string() + ": contact: ";
  const struct {
    bool is_stated, is_felt;
    std::string place;
    const char* key;
    const char* bodies;
  } settings[] = {
      {dem_gpu::has_adhesion(scene), has_spheres, contact, "adhesion", "spheres"},
      {dem_gpu::has_rolling_friction(scene), has_spheres, contact, "rolling_friction", "spheres"},
      {stiffness.spheres.has_value(), has_spheres, law, "sphere_stiffness", "spheres"},
      {stiffness.polyhedra.has_value(), has_polyhedra, law, "stiffness", "polyhedra"},
      {stiffness.overlap_at != dem_gpu::OverlapAt::face, has_polyhedra, law, "overlap_at", "polyhedra"},
      {has_cap, has_polyhedra, law, "depth_cap", "polyhedra"},
      {std::holds_alternative<dem_gpu::HardeningDepthPotential>(scene.polyhedral_law), has_polyhedra, law, "hardening",
       "polyhedra"},
  };
  std::vector<std::string> lines = idle_sections(description, scene);
  for (const auto& setting : settings)
    if (setting.is_stated && !setting.is_felt)
      lines.push_back(setting.place + setting.key + " is for contacts of " + setting.bodies +
                      ", of which the scene has none: it has no effect");
  return lines;
}

}  // namespace workflows
