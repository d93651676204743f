// SPDX-License-Identifier: Apache-2.0
#include "workflows/level_choice.h"

#include <gtest/gtest.h>

#include "dem_gpu/contact_cost.h"

namespace {

using namespace workflows;
using catalog::FitMode;

Level level(int parts, int vertex_cap, int faces, double error) {
  Level one;
  one.key.parts_asked = one.parts = parts;
  one.key.vertex_cap = vertex_cap;
  one.faces = faces;
  one.error.symmetric_difference = error;
  return one;
}

/// Costs 4.7, 9.7, 8.7, 18 and 12 contacts of cubes.
const std::vector<Level> kLadder{level(1, 16, 28, 0.114), level(1, 32, 58, 0.0945), level(4, 16, 85, 0.081),
                                 level(4, 32, 172, 0.0678), level(8, 16, 150, 0.0593)};

TEST(ContactCost, IsOneForCubesAndGrowsWithFaces) {
  EXPECT_DOUBLE_EQ(dem_gpu::contact_cost(1, 6), 1);
  EXPECT_GT(dem_gpu::contact_cost(4, 100), dem_gpu::contact_cost(4, 90));
  EXPECT_LT(dem_gpu::contact_cost(8, 100), dem_gpu::contact_cost(4, 100));
}

TEST(LevelChoice, FrontLeavesOutWhatIsDearerAndWorse) {
  EXPECT_EQ(on_front(kLadder), (std::vector<bool>{true, false, true, false, true}));
  EXPECT_EQ(on_front({level(2, 32, 50, 0.1), level(2, 64, 50, 0.1)}), (std::vector<bool>{true, true})) << "equal";
  EXPECT_TRUE(on_front({}).empty());
}

TEST(LevelChoice, CheapestWithinTheTolerance) {
  EXPECT_EQ(cheapest_level(kLadder, 0.2)->key.vertex_cap, 16);
  EXPECT_EQ(cheapest_level(kLadder, 0.0945)->parts, 4) << "cheaper than one part of 32 vertices";
  EXPECT_EQ(cheapest_level(LevelFilter{.vertex_cap = 32}(kLadder), 0.0945)->parts, 1);
  EXPECT_EQ(cheapest_level(kLadder, 0.07)->parts, 8);
  EXPECT_FALSE(cheapest_level(kLadder, 0.01));
  EXPECT_FALSE(cheapest_level(LevelFilter{.vertex_cap = 64}(kLadder), 0.2));
}

TEST(LevelChoice, LevelsAreListedByTheirKind) {
  std::vector<Level> levels{level(1, 32, 40, 0.1), level(4, 32, 40, 0.1), level(1, 64, 40, 0.1)};
  levels.back().key.face_cap = 24;
  levels.back().key.mode = FitMode::inscribed;
  EXPECT_EQ(listed(levels), "1, 4 parts of at most 32 vertices; 1 part of at most 64 vertices and 24 faces, inscribed");
  EXPECT_EQ(listed(std::vector<Level>{}), "no level");
}

TEST(LevelChoice, FilterTellsModesAndCapsApart) {
  std::vector<Level> levels = kLadder;
  levels.push_back(level(2, 32, 40, 0.09));
  levels.back().key.face_cap = 24;
  levels.push_back(level(2, 32, 60, 0.2));
  levels.back().key.mode = FitMode::enclosing;
  EXPECT_EQ(LevelFilter{}(levels).size(), 6u) << "volume-true, any caps";
  EXPECT_EQ(LevelFilter{.face_cap = 0}(levels).size(), 5u);
  EXPECT_EQ((LevelFilter{.vertex_cap = 32, .face_cap = 24}(levels).size()), 1u);
  EXPECT_EQ(LevelFilter{.mode = FitMode::enclosing}(levels).size(), 1u);
  EXPECT_TRUE(LevelFilter{.mode = FitMode::inscribed}(levels).empty());
  EXPECT_TRUE(on_front(levels).back()) << "each mode has a front of its own";
}

}  // namespace
