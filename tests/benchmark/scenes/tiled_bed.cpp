// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/tiled_bed.h"

#include "catalog/input_error.h"

namespace benchmark_scenes {
namespace {

/// Of the box between the planes "left" and "right" [m].
double box_width(const SpeedScene& speed_scene) {
  for (const dem_gpu::Wall& wall : speed_scene.make({}).walls)
    if (wall.name == "right") return std::get<dem_gpu::Plane>(wall.geometry).point.x;
  throw catalog::UsageError("scene '" + speed_scene.name + "' cannot be tiled; s1-box, s2 and s3 can");
}

}  // namespace

dem_gpu::Snapshot tiled(const SpeedScene& speed_scene, const dem_gpu::Snapshot& settled, int tiles) {
  if (tiles < 1) throw catalog::UsageError("tiles: expected 1 or more, got " + std::to_string(tiles));
  const double width = box_width(speed_scene);
  dem_gpu::Snapshot bed;
  bed.time = settled.time;
  for (int x = 0; x < tiles; ++x)
    for (int y = 0; y < tiles; ++y)
      for (std::size_t i = 0; i < settled.position.size(); ++i) {
        bed.active.push_back(settled.active[i]);
        bed.position.push_back(settled.position[i] + dem_gpu::Vec3{x * width, y * width, 0});
        bed.orientation.push_back(settled.orientation[i]);
        bed.velocity.push_back(settled.velocity[i]);
        bed.angular_velocity.push_back(settled.angular_velocity[i]);
      }
  return bed;
}

}  // namespace benchmark_scenes
