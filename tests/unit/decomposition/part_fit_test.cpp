// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/part_fit.h"

#include <gtest/gtest.h>

#include "decomposition/fit/column_measure.h"
#include "decomposition/fit/part_finish.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

TEST(ColumnMeasure, OverlapOfABoxWithABox) {
  const Solid solid(solids::box({0, 0, 0}, {1, 1, 1}), 1e5);
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1.0 : 0.5, i & 2 ? 1.0 : 0.0, i & 4 ? 1.5 : 0.25});
  SmallHull hull;
  ASSERT_TRUE(hull.build(points));
  for (const int stride : {1, 2}) {
    const ColumnOverlap measured = ColumnMeasure(solid, stride)(points, hull.faces());
    EXPECT_NEAR(measured.volume, 0.5 * 1.25, 0.03);
    EXPECT_NEAR(measured.overlap, 0.5 * 0.75, 0.03);
    EXPECT_NEAR(measured.volume / measured.overlap, 1.25 / 0.75, 1e-9);  // every column has the same lengths
  }
}

TEST(PartFit, FindsTheHalfBallInItsCell) {
  const Solid solid(solids::sphere(1, 4), 1e6);
  const std::vector<Plane> cell{Plane{{0, 0, 1}, 0}};
  Random random(1);
  const RegionMoments region = moments_of_points(solid.points_inside(cell, 2000, random), solid.volume_inside(cell));
  FitPlan plan;
  plan.vertices = 48;
  plan.volume = region.volume;
  const PartFit fit = finish_part(solid, cell, region, plan, 1);
  ASSERT_TRUE(fit.is_valid());
  EXPECT_NEAR(fit.volume / region.volume, 1, 1e-4);
  for (const Vec3& p : fit.points) EXPECT_LE(p.z, 0);
  SmallHull hull;
  ASSERT_TRUE(hull.build(fit.points));
  const double error = region.volume + ColumnMeasure(solid, 1)(fit.points, hull.faces()).misfit();
  EXPECT_LT(error / region.volume, 0.05);
}

TEST(PartFit, ProjectionEndsInTheCell) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Plane> cell;
    for (int k = 0; k < 5; ++k) cell.push_back({random.unit_vector(), 0.2 + random.uniform()});
    const Vec3 p = project_into_cell(3 * random.unit_vector(), cell, {0, 0, 0}, 1e-6);
    for (const Plane& plane : cell) EXPECT_LE(plane.signed_distance(p), 0);
  }
}

}  // namespace
}  // namespace decomposition
