// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/resumed_scene.h"

#include <algorithm>
#include <utility>

#include "catalog/input_error.h"

namespace benchmark_scenes {
namespace {

/// Of the thinner body's least width: another law may hold bodies farther apart than the one that settled them.
constexpr double kLargestStartOverlap = 0.5;

}  // namespace

dem_gpu::Scene resumed(dem_gpu::Scene scene, const dem_gpu::Snapshot& snapshot) {
  if (snapshot.position.size() != scene.bodies.size())
    throw catalog::InputError("benchmark scene: the snapshot has " + std::to_string(snapshot.position.size()) +
                              " bodies, the scene " + std::to_string(scene.bodies.size()));
  std::vector<dem_gpu::Body> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!snapshot.active[i]) continue;
    dem_gpu::Body body = scene.bodies[i];
    body.position = snapshot.position[i];
    body.orientation = snapshot.orientation[i];
    body.velocity = snapshot.velocity[i];
    body.angular_velocity = snapshot.angular_velocity[i];
    bodies.push_back(body);
  }
  scene.bodies = std::move(bodies);
  for (dem_gpu::Wall& wall : scene.walls)
    if (wall.removed_at) *wall.removed_at = std::max(0.0, *wall.removed_at - snapshot.time);
  scene.run.largest_start_overlap = kLargestStartOverlap;
  return scene;
}

}  // namespace benchmark_scenes
