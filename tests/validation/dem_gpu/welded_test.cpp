// SPDX-License-Identifier: Apache-2.0
// Flush objects welded together are one solid to what slides over their seam.
#include <gtest/gtest.h>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;

dem_gpu::Wall block(const std::string& name, const Vec3& size, const Vec3& centre) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part(size), {}, centre)};
  return wall;
}

TEST(Welded, ACubeSlidesOverTheSeamOfTwoBlocks) {
  // Without friction: whatever the seam does shows as lost speed, a hop or a turn.
  dem_gpu::Scene scene = empty_scene(0.5, 0);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.shapes = {box_shape({0.02, 0.02, 0.02})};
  scene.bodies = {body_at(0, {-0.03, 0.001, 0.01}, {}, {0.5, 0, 0})};
  scene.walls = {block("left", {0.1, 0.1, 0.05}, {-0.05, 0, -0.025}),
                 block("right", {0.1, 0.1, 0.05}, {0.05, 0, -0.025})};
  dem_gpu::Simulation simulation(scene);
  Real hop = 0, turn = 0;
  while (simulation.time() < 0.12) {
    simulation.advance(20);
    const auto snapshot = simulation.snapshot();
    hop = std::max(hop, std::abs(snapshot.position[0].z - 0.01));
    turn = std::max(turn, norm(Vec3{snapshot.orientation[0].x, snapshot.orientation[0].y, snapshot.orientation[0].z}));
  }
  const auto end = simulation.snapshot();
  std::printf("over the seam: hop %.1e, turn %.1e, speed lost %.1e\n", hop / 0.02, 2 * turn,
              1 - end.velocity[0].x / 0.5);
  EXPECT_GT(end.position[0].x, 0.025);
  EXPECT_LT(hop, 1e-4 * 0.02);                         // a ten-thousandth of its size
  EXPECT_LT(2 * turn, 1e-4);                           // [rad]
  EXPECT_LT(std::abs(end.velocity[0].x - 0.5), 5e-5);  // 1e-4 of its speed
}

}  // namespace
