// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/dem_scenes.h"

namespace test_support {

/// Every kind of contact: cubes of parts, rocks and balls falling into a turning drum with a lifter, over a gate that
/// opens at 0.04 s, out of the bottom.
inline dem_gpu::Scene mixed_scene() {
  dem_gpu::Scene scene = empty_scene(0.5, 0.4);
  scene.gravity = {0, 0, -9.81};
  scene.materials.push_back({"steel", 7800});
  scene.contact.assign(2, {{0.5, 0.4}, {0.6, 0.2}});
  scene.contact[1] = {{0.6, 0.2}, {0.7, 0.3}};
  scene.contact[1][1].rolling_friction = 0.05;
  scene.contact[1][1].adhesion = 0.02;
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.sphere_law = dem_gpu::LinearSpring{2e4};
  std::mt19937 random(77);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}, {2, 2, 1}),
                  dem_gpu::polyhedral_shape("rock", {random_convex_part(random, 20, {0.012, 0.01, 0.008})}),
                  dem_gpu::sphere_shape("ball", 0.008)};
  for (int x = -1; x <= 1; ++x)
    for (int y = 0; y <= 1; ++y)
      for (int z = 0; z < 4; ++z) {
        scene.bodies.push_back(
            body_at((x + y + z + 3) % 3, {0.027 * x, 0.03 * y - 0.015, 0.03 * z - 0.03}, random_rotation(random)));
        scene.bodies.back().material = scene.bodies.back().shape == 2;
        scene.bodies.back().velocity = {0.1 * y, 0, -1.5};
      }
  dem_gpu::Wall shell, lifter, gate, front, back;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -0.04, 0}, {0, 1, 0}, 0.08, 0.1};
  shell.material = 1;
  shell.motion.angular_velocity = {0, 8, 0};
  shell.motion.ramp_time = 0.01;
  lifter = shell;
  lifter.name = "lifter";
  lifter.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.08, 0.02}), {}, {0, 0, -0.092})};
  gate.name = "gate";
  gate.geometry = dem_gpu::Disc{{0, 0, -0.055}, {0, 0, 1}, 0.06};
  gate.removed_at = 0.04;
  front.name = "front";
  front.geometry = dem_gpu::Plane{{0, -0.04, 0}, {0, 1, 0}};
  back.name = "back";
  back.geometry = dem_gpu::Plane{{0, 0.04, 0}, {0, -1, 0}};
  scene.walls = {shell, lifter, gate, front, back};
  scene.outflow = dem_gpu::Outflow{{1, 0, 0}, -0.08};
  scene.run.time_step = 1e-5;
  return scene;
}

}  // namespace test_support
