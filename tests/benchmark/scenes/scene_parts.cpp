// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/scene_parts.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/benchmark/scenes/hull_part.h"

namespace benchmark_scenes {

using dem_gpu::Scene;
using dem_gpu::Vec3;

Scene empty_scene(const std::string& name, double restitution, const SceneOptions& options) {
  Scene scene;
  scene.name = name;
  scene.materials = {{"stone", kDensity}};
  scene.contact = {{{restitution, 0.5}}};
  scene.energy_ledger = options.has_ledger;
  return scene;
}

void add_wall(Scene& scene, const std::string& name, decltype(dem_gpu::Wall::geometry) geometry,
              const dem_gpu::Motion& motion) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = std::move(geometry);
  wall.motion = motion;
  scene.walls.push_back(std::move(wall));
}

void add_sides(Scene& scene, double width) {
  add_wall(scene, "left", dem_gpu::Plane{{}, {1, 0, 0}});
  add_wall(scene, "right", dem_gpu::Plane{{width, 0, 0}, {-1, 0, 0}});
  add_wall(scene, "front", dem_gpu::Plane{{}, {0, 1, 0}});
  add_wall(scene, "back", dem_gpu::Plane{{0, width, 0}, {0, -1, 0}});
}

void add_floor(Scene& scene) { add_wall(scene, "floor", dem_gpu::Plane{{}, {0, 0, 1}}); }

dem_gpu::Motion turning(const Drum& drum) {
  dem_gpu::Motion motion;
  motion.angular_velocity = {0, drum.speed, 0};
  return motion;
}

void add_drum(Scene& scene, const Drum& drum) {
  const double half = drum.length / 2;
  const dem_gpu::Motion of_ends = drum.ends_turn ? turning(drum) : dem_gpu::Motion{};
  add_wall(scene, "shell", dem_gpu::Cylinder{{0, -half, 0}, {0, 1, 0}, drum.length, drum.radius}, turning(drum));
  add_wall(scene, "near end", dem_gpu::Plane{{0, -half, 0}, {0, 1, 0}}, of_ends);
  add_wall(scene, "far end", dem_gpu::Plane{{0, half, 0}, {0, -1, 0}}, of_ends);
}

void add_lifters(Scene& scene, const Drum& drum, const Lifters& lifters) {
  for (int i = 0; i < lifters.count; ++i) {
    const double angle = 2 * std::numbers::pi * i / lifters.count;
    const Vec3 outward{std::cos(angle), 0, std::sin(angle)}, across{-std::sin(angle), 0, std::cos(angle)};
    std::vector<Vec3> corners;
    for (const double radius : {drum.radius - lifters.height, drum.radius + lifters.height})
      for (const double side : {-lifters.width / 2, lifters.width / 2})
        for (const double along : {-drum.length / 2, drum.length / 2})
          corners.push_back(radius * outward + side * across + Vec3{0, along, 0});
    add_wall(scene, "lifter " + std::to_string(i), dem_gpu::VolumeObject{hull_part(corners)}, turning(drum));
    scene.walls.back().contact_class = "lifter";
  }
}

void set_polyhedral_law(Scene& scene, const SceneOptions& options, double speed, double flat_overlap) {
  const double overlap = options.flat_overlap > 0 ? options.flat_overlap : flat_overlap;
  if (options.law == Law::depth_potential)
    scene.polyhedral_law = dem_gpu::DepthPotential{};
  else
    scene.polyhedral_law = dem_gpu::OverlapVolume{};
  const double stiffness = dem_gpu::stiffness_for_overlap(scene, speed, overlap);
  std::visit([&](auto& law) { law.stiffness = stiffness; }, scene.polyhedral_law);
  scene.run.steps_per_contact = options.steps_per_contact;
}

double growth(int bodies, int own, int dimensions) {
  return bodies > 0 ? std::pow(bodies / static_cast<double>(own), 1.0 / dimensions) : 1;
}

}  // namespace benchmark_scenes
