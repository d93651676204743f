// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/ray_grid.h"

#include <gtest/gtest.h>

#include "decomposition/solid/solid.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

std::vector<Vec3> points_of(const catalog::TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const catalog::Point& p : mesh.vertices) points.push_back(to_vec3(p));
  return points;
}

TEST(RayGrid, RaysThroughEdgesAndDiagonalsMeetTheSurfaceOnce) {
  // 4 x 4 rays at 1/8, 3/8, ...: those with equal indices run exactly through the diagonals of top and bottom.
  const catalog::TriangleMesh cube = solids::box({0, 0, 0}, {1, 1, 1});
  const RayGrid grid{0, 0, 0.25, 4, 4, {}, {}};
  const RayIntervals intervals = intersect(grid, points_of(cube), cube.faces);
  ASSERT_EQ(intervals.intervals.size(), 16u);
  for (std::size_t ray = 0; ray < 16; ++ray) {
    EXPECT_EQ(intervals.first[ray], ray);
    EXPECT_EQ(intervals.intervals[ray].low, 0);
    EXPECT_EQ(intervals.intervals[ray].high, 1);
  }
}

TEST(RayGrid, HollowSolidHasTwoIntervals) {
  catalog::TriangleMesh shell = solids::box({0, 0, 0}, {4, 4, 4});
  const catalog::TriangleMesh hole = solids::box({1, 1, 1}, {3, 3, 3});
  for (const catalog::Point& p : hole.vertices) shell.vertices.push_back(p);
  for (const catalog::Triangle& face : hole.faces) shell.faces.push_back({face[0] + 8, face[2] + 8, face[1] + 8});
  const RayGrid grid{1.9, 1.9, 0.2, 1, 1, {}, {}};
  const RayIntervals intervals = intersect(grid, points_of(shell), shell.faces);
  ASSERT_EQ(intervals.intervals.size(), 2u);
  EXPECT_DOUBLE_EQ(intervals.intervals[0].high, 1);
  EXPECT_DOUBLE_EQ(intervals.intervals[1].low, 3);
}

TEST(Solid, ColumnsAndFieldHoldTheVolume) {
  const catalog::TriangleMesh sphere = solids::sphere(1, 4);
  const Solid solid(sphere, 1e5);
  EXPECT_NEAR(solid.volume_inside({}) / solid.volume(), 1, 2e-3);
  EXPECT_NEAR(solid.volume_inside({Plane{{0, 0.6, 0.8}, 0}}) / solid.volume(), 0.5, 2e-3);
  EXPECT_EQ(solid.occupancy({0, 0, 0}), 1);
  EXPECT_EQ(solid.occupancy({1.5, 0, 0}), 0);
  EXPECT_NEAR(solid.occupancy({0, 0, 0.997}), 0.5, 0.15);
}

TEST(Solid, SlabKeepsCellsAcross) {
  const Solid slab(solids::box({0, 0, 0}, {10, 10, 0.2}), 1e5);
  EXPECT_GE(0.2 / slab.cell(), 3);
}

TEST(Solid, PointsInsideFollowTheCell) {
  const Solid solid(solids::box({0, 0, 0}, {1, 2, 3}), 1e5);
  Random random(3);
  const std::vector<Plane> cell{Plane{{0, 1, 0}, 1}};
  const std::vector<Vec3> points = solid.points_inside(cell, 3000, random);
  EXPECT_NEAR(static_cast<double>(points.size()), 3000, 2);
  for (const Vec3& p : points) EXPECT_LE(p.y, 1);
  // Semi-axes of the ellipsoid of inertia of a box: sqrt(5/12) of its edges.
  const RegionMoments moments = moments_of_points(points, 3);
  EXPECT_NEAR(norm(moments.semi_axes[2]), 3 * std::sqrt(5.0 / 12), 0.02);
  EXPECT_NEAR(moments.centroid.y, 0.5, 0.02);
}

}  // namespace
}  // namespace decomposition
