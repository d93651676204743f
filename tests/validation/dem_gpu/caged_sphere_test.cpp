// SPDX-License-Identifier: Apache-2.0
// A sphere that many others hold: the dampers of all its contacts together must not take more of its motion in a step
// than there is.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kRadius = 0.01, kPressedIn = 2e-4;  // [m]

/// Towards the neighbours: along the axes (6), or as in a face-centred lattice (12).
std::vector<Vec3> directions(int neighbours) {
  std::vector<Vec3> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const Real s : {Real(-1), Real(1)})
      if (neighbours == 6) {
        Real at[3] = {};
        at[axis] = s;
        all.push_back({at[0], at[1], at[2]});
      } else {
        for (const Real t : {Real(-1), Real(1)}) {
          Real at[3] = {};
          at[axis] = s * std::numbers::sqrt2 / 2;
          at[(axis + 1) % 3] = t * std::numbers::sqrt2 / 2;
          all.push_back({at[0], at[1], at[2]});
        }
      }
  return all;
}

/// Fixed spheres pressed on a free one that spins.
Scene cage(int neighbours, double restitution, double steps_per_contact, const Vec3& spin) {
  Scene scene = empty_scene(restitution, 0.5);
  scene.gravity = {};
  scene.shapes = {dem_gpu::sphere_shape("ball", kRadius)};
  scene.bodies.push_back(body_at(0, {}));
  scene.bodies[0].angular_velocity = spin;
  for (const Vec3& direction : directions(neighbours)) {
    scene.bodies.push_back(body_at(0, (2 * kRadius - kPressedIn) * direction));
    scene.bodies.back().is_fixed = true;
  }
  const Real mass = 2500 * scene.shapes[0].volume;
  scene.run.time_step = std::numbers::pi * std::sqrt(mass / 1e5) / steps_per_contact;
  return scene;
}

TEST(CagedSphere, ComesToRest) {
  struct Held {
    int neighbours;
    double restitution, steps_per_contact;
  };
  for (const auto& [neighbours, restitution, steps_per_contact] :
       {Held{6, 0.1, 10}, Held{12, 0.5, 10}, Held{12, 0.3, 20}})
    for (const Vec3& spin : {Vec3{0, 0, 0.5}, Vec3{0.3, -0.2, 0.4}}) {
      Simulation simulation(cage(neighbours, restitution, steps_per_contact, spin));
      simulation.advance(1000);
      const auto end = simulation.snapshot();
      std::printf("  %d neighbours, restitution %.1f: %.1e of the spin is left after 1000 steps\n", neighbours,
                  restitution, norm(end.angular_velocity[0]) / norm(spin));
      EXPECT_LT(norm(end.angular_velocity[0]), 1e-3 * norm(spin));
      EXPECT_LT(norm(end.velocity[0]), 1e-3 * kRadius * norm(spin));
      EXPECT_LT(norm(end.position[0]), 1e-3 * kPressedIn);
    }
}

}  // namespace
