// SPDX-License-Identifier: Apache-2.0
// Blocks of steps, launched or captured, leave the same bytes as the steps one by one. On the CPU a captured block is a
// list of launches with their arguments, so that all but the capture itself is tested without a GPU.
#include <gtest/gtest.h>

#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/periodic_scene.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace test_support;
using dem_gpu::StepBlocks;

/// Balls roll over a floor of two flush slabs towards a wall, cubes and balls drop on them: nothing moves but bodies.
dem_gpu::Scene resting_walls() {
  dem_gpu::Scene scene = empty_scene(0.6, 0.4);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}), dem_gpu::sphere_shape("ball", 0.008)};
  std::mt19937 random(5);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y) {
      scene.bodies.push_back(body_at(1, {-0.05 + 0.03 * x, -0.03 + 0.03 * y, 0.009}));
      scene.bodies.back().velocity = {0.8, 0.1 * y, 0};
      scene.bodies.push_back(body_at((x + y) % 2, {-0.05 + 0.03 * x, -0.03 + 0.03 * y, 0.05}, random_rotation(random)));
    }
  dem_gpu::Wall left, right, end;
  left.name = "left";
  left.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.2, 0.2, 0.1}), {}, {-0.1, 0, -0.05})};
  right.name = "right";
  right.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.2, 0.2, 0.1}), {}, {0.1, 0, -0.05})};
  end.name = "end";
  end.geometry = dem_gpu::Plane{{0.08, 0, 0}, {-1, 0, 0}};
  scene.walls = {left, right, end};
  scene.run.time_step = 1e-5;
  return scene;
}

/// The whole state, and what was counted.
std::string outcome(const dem_gpu::Simulation& simulation) {
  const TemporaryFolder folder;
  simulation.write_checkpoint(folder.path());
  return read_bytes(folder / "checkpoint.h5");
}

dem_gpu::Simulation simulation_in(StepBlocks blocks, const dem_gpu::Scene& scene) {
  dem_gpu::Simulation simulation(scene);
  simulation.set_step_blocks(blocks);
  return simulation;
}

constexpr int kSteps = 6000;  // past the opening of the mixed scene's gate

void expect_the_same(const dem_gpu::Scene& scene, StepBlocks blocks) {
  dem_gpu::Simulation single = simulation_in(StepBlocks::none, scene), in_blocks = simulation_in(blocks, scene);
  for (const int steps : {1, 2, 50, 947, kSteps - 1000}) {
    single.advance(steps);
    in_blocks.advance(steps);
    EXPECT_EQ(single.step(), in_blocks.step());
    EXPECT_EQ(single.quality().list_rebuilds, in_blocks.quality().list_rebuilds);
    EXPECT_TRUE(outcome(single) == outcome(in_blocks)) << "after step " << single.step();
    const auto loads = single.take_wall_loads(), block_loads = in_blocks.take_wall_loads();
    for (std::size_t w = 0; w < loads.size(); ++w) EXPECT_EQ(loads[w].force, block_loads[w].force) << "wall " << w;
    EXPECT_EQ(single.snapshot().wall_present, in_blocks.snapshot().wall_present);
  }
  const dem_gpu::StepCounts counts = in_blocks.step_counts();
  EXPECT_EQ(counts.by_themselves + counts.in_blocks, kSteps);
  EXPECT_GT(counts.in_blocks, 0.8 * kSteps);
  EXPECT_GT(counts.halts, 2);
  EXPECT_EQ(single.step_counts().in_blocks, 0);
}

TEST(StepBlocks, MovingWallsAGateAndAnOutflow) { expect_the_same(mixed_scene(), StepBlocks::launched); }

TEST(StepBlocks, PeriodicBox) {
  expect_the_same(periodic_incline(), StepBlocks::launched);
  expect_the_same(periodic_incline(), StepBlocks::captured);
}

TEST(StepBlocks, WallsAtRest) {
  expect_the_same(resting_walls(), StepBlocks::launched);
  expect_the_same(resting_walls(), StepBlocks::captured);
}

TEST(StepBlocks, AreReplayedWhereStepsRepeatThemselves) {
  for (const bool moves : {false, true}) {
    dem_gpu::Scene scene = resting_walls();
    if (moves) scene.walls[2].motion.velocity = {-0.1, 0, 0};
    dem_gpu::Simulation simulation = simulation_in(StepBlocks::captured, scene);
    simulation.advance(2000);
    EXPECT_EQ(simulation.step_counts().replays > 0, !moves);
    EXPECT_GT(simulation.step_counts().in_blocks, 1000);
  }
}

/// A gate that stays where it is until it opens leaves the steps before and after it to be captured.
TEST(StepBlocks, AWallThatGoesEndsABlock) {
  dem_gpu::Scene scene = resting_walls();
  scene.walls[2].removed_at = 0.01;
  expect_the_same(scene, StepBlocks::captured);
}

TEST(StepBlocks, ALostBodyIsNamedAtItsStep) {
  const auto message = [](StepBlocks blocks) {
    dem_gpu::Simulation simulation = simulation_in(blocks, resting_walls());
    simulation.advance(100);
    simulation.push(3, {0, 0, 50}, {});
    try {
      simulation.advance(100);
      return std::string("went on");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  const std::string single = message(StepBlocks::none);
  EXPECT_NE(single.find("step 101,"), std::string::npos) << single;
  EXPECT_EQ(message(StepBlocks::launched), single);
  EXPECT_EQ(message(StepBlocks::captured), single);
}

TEST(StepBlocks, GoOnFromACheckpoint) {
  const TemporaryFolder folder;
  dem_gpu::Simulation whole = simulation_in(StepBlocks::none, resting_walls());
  whole.advance(700);
  whole.write_checkpoint(folder.path());
  whole.advance(1300);
  for (const StepBlocks blocks : {StepBlocks::launched, StepBlocks::captured}) {
    dem_gpu::Simulation resumed = simulation_in(blocks, resting_walls());
    resumed.advance(900);  // blocks of another list
    resumed.read_checkpoint(folder.path());
    resumed.advance(1300);
    EXPECT_TRUE(outcome(whole) == outcome(resumed));
  }
}

}  // namespace
