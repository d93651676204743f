// SPDX-License-Identifier: Apache-2.0
// Spheres placed so that they touch by the last bit only.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem_gpu/simulation.h"
#include "tests/support/dem_scenes.h"

namespace {

using namespace test_support;

TEST(JustTouching, SpheresWithoutDepthStayWhereTheyAre) {
  constexpr Real kRadius = 0.01;
  std::mt19937 random(1);
  int placed = 0;
  for (int i = 0; i < 200 && placed < 10; ++i) {
    const Vec3 offset = 2 * kRadius * random_direction(random);
    const bool touches = norm_squared(offset) < 2 * kRadius * 2 * kRadius;
    if (!touches || kRadius - (norm(offset) - kRadius) > 0) continue;
    ++placed;
    for (const bool is_hertz : {false, true}) {
      dem_gpu::Scene scene = empty_scene(1, 0);
      if (is_hertz)
        scene.sphere_law = dem_gpu::Hertz{};
      else
        scene.sphere_law = dem_gpu::LinearSpring{0.1};
      scene.shapes = {dem_gpu::sphere_shape("ball", kRadius)};
      scene.bodies = {body_at(0, {0, 0, 0}), body_at(0, offset)};
      scene.run.time_step = 1e-5;
      dem_gpu::Simulation simulation(scene);
      simulation.advance(20);
      EXPECT_LT(norm(simulation.snapshot().position[1] - offset), 1e-12);
    }
  }
  EXPECT_EQ(placed, 10);
}

}  // namespace
