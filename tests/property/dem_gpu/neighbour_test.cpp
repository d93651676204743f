// SPDX-License-Identifier: Apache-2.0
// Contacts found through the neighbour list against all pairs.
#include <gtest/gtest.h>

#include <set>

#include "dem_gpu/simulation.h"
#include "tests/support/pair_integrals.h"
#include "tests/support/periodic_scene.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

using Pairs = std::set<std::pair<int, int>>;

Pairs found(const dem_gpu::Snapshot& snapshot) {
  Pairs pairs;
  for (const auto& contact : snapshot.contacts) pairs.insert(std::minmax(contact.body_a, contact.body_b));
  return pairs;
}

TEST(NeighbourList, FindsAllTouchingSpheres) {
  // Sizes 1:8, clustered, some far away; a list as it is built and as bodies move between rebuilds.
  std::mt19937 random(31);
  std::uniform_real_distribution<Real> place(0, 0.3), size(0.25, 2);
  Scene scene = empty_scene(1, 0);
  scene.sphere_law = dem_gpu::LinearSpring{0.1};  // soft: they pass through one another
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  for (int i = 0; i < 300; ++i) {
    scene.bodies.push_back(
        body_at(0, {place(random), place(random), place(random)}, {}, 0.5 * random_direction(random)));
    scene.bodies.back().scale = size(random);
    if (i % 50 == 0) scene.bodies.back().position += Vec3{1000, -2000, 500};
  }
  scene.walls = {floor_wall()};
  scene.run.time_step = 4e-4;
  scene.run.largest_start_overlap = 10;
  Simulation simulation(scene);
  std::size_t total = 0;
  for (int round = 0; round < 30; ++round) {
    simulation.advance(round == 0 ? 1 : 7);
    const auto now = simulation.snapshot();
    Pairs expected;
    for (int i = 0; i < 300; ++i) {
      if (now.position[i].z < 0.01 * scene.bodies[i].scale) expected.insert({-1, i});
      for (int j = i + 1; j < 300; ++j)
        if (norm(now.position[i] - now.position[j]) < 0.01 * (scene.bodies[i].scale + scene.bodies[j].scale))
          expected.insert({i, j});
    }
    EXPECT_EQ(found(now), expected);
    total += expected.size();
  }
  EXPECT_GT(total, 3000u);
  EXPECT_GT(simulation.quality().list_rebuilds, 1);
}

TEST(NeighbourList, FindsAllTouchingInACrowd) {
  // Bodies that fly to one place: more pairs each than the list has room for at its first search.
  Scene scene = empty_scene(1, 0);
  scene.sphere_law = dem_gpu::LinearSpring{0.1};  // soft: they pass through one another
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  scene.run.time_step = 4e-4;
  constexpr int kSide = 7, kCount = kSide * kSide * kSide, kSteps = 200;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 place = 0.021 * Vec3{Real(i % kSide), Real(i / kSide % kSide), Real(i / kSide / kSide)};
    scene.bodies.push_back(body_at(0, place, {}, -1 / (kSteps * scene.run.time_step) * place));
  }
  Simulation simulation(scene);
  simulation.advance(7 * kSteps / 10);
  const auto now = simulation.snapshot();
  Pairs expected;
  for (int i = 0; i < kCount; ++i)
    for (int j = i + 1; j < kCount; ++j)
      if (norm(now.position[i] - now.position[j]) < 0.02) expected.insert({i, j});
  EXPECT_GT(expected.size(), 20u * kCount);
  EXPECT_EQ(found(now), expected);
  EXPECT_EQ(now.contacts.size(), expected.size()) << "each once";
}

TEST(NeighbourList, FindsAllTouchingAcrossTheFacesOfABox) {
  // In boxes from the narrowest allowed on; each pair once, at its nearest images.
  std::mt19937 random(33);
  std::uniform_real_distribution<Real> share(0, 1), size(0.5, 1);
  for (const std::string axes : {"x", "yz", "xyz"})
    for (const Real width : {0.041, 0.05, 0.2}) {
      Scene scene = empty_scene(1, 0);
      scene.sphere_law = dem_gpu::LinearSpring{0.1};  // soft: they pass through one another
      scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
      const Vec3 low{-0.3, 0.1, 7};
      scene.periodic = periodic_box(low, width * Vec3{1, 1, 1}, axes);
      const int count = width < 0.1 ? 12 : 250;
      for (int i = 0; i < count; ++i) {
        const Vec3 place = low + width * Vec3{share(random), share(random), share(random)};
        scene.bodies.push_back(body_at(0, place, {}, 0.5 * random_direction(random)));
        scene.bodies.back().scale = size(random);
      }
      scene.run.time_step = 4e-4;
      scene.run.largest_start_overlap = 10;
      Simulation simulation(scene);
      std::size_t total = 0;
      for (int round = 0; round < 20; ++round) {
        simulation.advance(round == 0 ? 1 : 7);
        const auto now = simulation.snapshot();
        Pairs expected;
        for (int i = 0; i < count; ++i)
          for (int j = i + 1; j < count; ++j)
            if (norm(nearest_offset(*scene.periodic, now.position[i], now.position[j])) <
                0.01 * (scene.bodies[i].scale + scene.bodies[j].scale))
              expected.insert({i, j});
        EXPECT_EQ(found(now), expected) << axes << " " << width;
        EXPECT_EQ(now.contacts.size(), expected.size()) << "each once";
        total += expected.size();
      }
      EXPECT_GT(total, 50u);
      EXPECT_GT(simulation.quality().list_rebuilds, 1);
    }
}

TEST(NeighbourList, FindsAllTouchingPolyhedra) {
  std::mt19937 random(32);
  std::uniform_real_distribution<Real> place(0, 0.12);
  Scene scene = empty_scene(1, 0);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e3};
  const auto part = moved_part(random_convex_part(random, 12, {0.012, 0.01, 0.006}), {}, {});
  scene.shapes = {dem_gpu::polyhedral_shape("rock", {part}), box_shape({0.02, 0.02, 0.01}, {2, 1, 1})};
  const auto parts = [&](int shape) { return std::get<dem_gpu::PolyhedralShape>(scene.shapes[shape].geometry).parts; };
  for (int i = 0; i < 60; ++i)
    scene.bodies.push_back(body_at(i % 2, {place(random), place(random), place(random)}, random_rotation(random),
                                   0.1 * random_direction(random)));
  scene.run.largest_start_overlap = 10;
  const PairIntegrals integrals[2][2] = {{{parts(0), parts(0)}, {parts(0), parts(1)}},
                                         {{parts(1), parts(0)}, {parts(1), parts(1)}}};
  Simulation simulation(scene);
  for (int round = 0; round < 5; ++round) {
    simulation.advance(3);
    const auto now = simulation.snapshot();
    Pairs expected;
    for (int i = 0; i < 60; ++i)
      for (int j = i + 1; j < 60; ++j)
        if (integrals[i % 2][j % 2].volume({now.position[i], now.orientation[i]},
                                           {now.position[j], now.orientation[j]}) > 1e-18)
          expected.insert({i, j});
    EXPECT_EQ(found(now), expected);
    EXPECT_GT(expected.size(), 10u);
  }
}

}  // namespace
