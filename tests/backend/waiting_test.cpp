// SPDX-License-Identifier: Apache-2.0
// Pairs of polyhedra that are apart are not looked at until the bodies have come far enough. In a periodic box pairs do
// not wait: with its faces far away the same bodies must go the same way, bit for bit.
#include <gtest/gtest.h>

#include <random>

#include "dem_gpu/simulation.h"
#include "tests/support/non_convex_bodies.h"
#include "tests/support/periodic_scene.h"

namespace {

using namespace test_support;

/// Cubes and hexapods, turned at random and spinning, flung at each other again and again by a pull towards the middle
/// of opposite pairs.
dem_gpu::Scene swarm() {
  dem_gpu::Scene scene;
  scene.gravity = {};
  scene.materials = {{"stone", 2700}};
  scene.contact = {{{0.8, 0.4}}};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.shapes = {box_shape({1, 1, 1}), dem_gpu::polyhedral_shape("hexapod", hexapod())};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  for (int i = 0; i < 27; ++i) {
    const Vec3 place{Real(i % 3 - 1), Real(i / 3 % 3 - 1), Real(i / 9 - 1)};
    dem_gpu::Body body;
    body.shape = i % 5 == 0 ? 1 : 0;
    body.scale = body.shape == 1 ? 0.35 : 1;
    body.position = 2.2 * place;
    body.orientation = dem_gpu::normalized({uniform(random), uniform(random), uniform(random), uniform(random)});
    body.velocity = -3 * place + Vec3{uniform(random), uniform(random), uniform(random)};
    body.angular_velocity = 4 * Vec3{uniform(random), uniform(random), uniform(random)};
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(WaitingPairs, MissNoContact) {
  dem_gpu::Scene scene = swarm();
  dem_gpu::Simulation waiting(scene);
  scene.periodic = periodic_box({-50, -50, -50}, {100, 100, 100});
  dem_gpu::Simulation looking(scene);
  std::int64_t touching = 0;
  for (int i = 0; i < 40; ++i) {
    waiting.advance(50);
    looking.advance(50);
    touching += waiting.bulk().contacts;
    const auto a = waiting.snapshot(), b = looking.snapshot();
    for (std::size_t k = 0; k < a.position.size(); ++k) {
      ASSERT_EQ(a.position[k], b.position[k]) << "body " << k << " after " << waiting.step() << " steps";
      ASSERT_EQ(a.orientation[k], b.orientation[k]);
      ASSERT_EQ(a.velocity[k], b.velocity[k]);
    }
  }
  EXPECT_GT(touching, 50) << "of 40 looks: bodies do meet";
}

}  // namespace
