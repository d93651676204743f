// SPDX-License-Identifier: Apache-2.0
#include "workflows/initial_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "workflows/convex_hull.h"

namespace workflows {
namespace {

dem_gpu::Wall wall(decltype(dem_gpu::Wall::geometry) geometry) {
  dem_gpu::Wall wall;
  wall.geometry = std::move(geometry);
  return wall;
}

double reach_into(const dem_gpu::Wall& wall, const dem_gpu::Vec3& centre, double radius) {
  return WallReach(wall).reach_of(centre, radius);
}

TEST(InitialState, ReachIntoWallsOfEachKind) {
  EXPECT_NEAR(reach_into(wall(dem_gpu::Plane{{0, 0, 1}, {0, 0, 1}}), {5, 5, 1.2}, 0.3), 0.1, 1e-15);
  const dem_gpu::Wall disc = wall(dem_gpu::Disc{{0, 0, 0}, {0, 0, 1}, 1});
  EXPECT_NEAR(reach_into(disc, {0.5, 0, 0.2}, 0.3), 0.1, 1e-15);
  EXPECT_NEAR(reach_into(disc, {1.4, 0, 0.3}, 0.6), 0.1, 1e-15);  // rim at distance 0.5
  const dem_gpu::Wall cylinder = wall(dem_gpu::Cylinder{{0, 0, 0}, {0, 0, 1}, 2, 1});
  EXPECT_NEAR(reach_into(cylinder, {0.8, 0, 1}, 0.3), 0.1, 1e-15);
  EXPECT_LT(reach_into(cylinder, {5, 0, 3}, 0.3), 0);  // above its end
  // 45 degree cone from radius 0 to 1: at height 0.5 on the axis the surface is sqrt(0.125) away.
  const dem_gpu::Wall cone = wall(dem_gpu::Cone{{0, 0, 0}, {0, 0, 1}, 1, 0, 1});
  EXPECT_NEAR(reach_into(cone, {0, 0, 0.5}, 0.4), 0.4 - std::sqrt(0.125), 1e-15);
}

TEST(InitialState, ReachIntoABlockIsMeasuredToFaceEdgeAndCorner) {
  std::vector<catalog::Point> corners;
  for (int c = 0; c < 8; ++c) corners.push_back({double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)});
  const dem_gpu::Wall block = wall(dem_gpu::VolumeObject{convex_hull(corners)});
  EXPECT_NEAR(reach_into(block, {0.5, 0.3, 1.5}, 0), -0.5, 1e-14);
  EXPECT_NEAR(reach_into(block, {0.5, 1.3, 1.4}, 0), -0.5, 1e-14);
  EXPECT_NEAR(reach_into(block, {2, 2, 2}, 0), -std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(reach_into(block, {0.5, 0.5, 0.9}, 0), 0.1, 1e-14);
}

TEST(InitialState, BallsOfDifferentFillsMustBeApart) {
  const std::vector<std::string> names{"fill \"ore\"", "fill \"balls\""};
  EXPECT_EQ(
      overlapping_balls({{{0, 0, 0}, 1, 0}, {{2, 0, 0}, 1, 1}, {{0.5, 0, 0}, 1, 0}}, names),
      "bodies of fill \"ore\" and fill \"balls\" would start inside one another; move their regions apart, or give "
      "both the same region to mix them");
  EXPECT_EQ(overlapping_balls({{{0, 0, 0}, 1, 0}, {{2, 0, 0}, 1, 1}, {{0, 3, 0}, 1, 1}}, names), "");
}

}  // namespace
}  // namespace workflows
