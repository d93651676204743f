// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/small_hull.h"

#include <gtest/gtest.h>

#include "decomposition/geometry/faceted_hull.h"
#include "decomposition/geometry/random.h"

namespace decomposition {
namespace {

TEST(SmallHull, TetrahedronWithAPointInside) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.1, 0.1, 0.1}, {0, 1, 0}, {0, 0, 1}};
  SmallHull hull;
  ASSERT_TRUE(hull.build(points));
  EXPECT_NEAR(hull.volume(), 1.0 / 6, 1e-15);
  EXPECT_EQ(hull.vertex_count(), 4);
  EXPECT_FALSE(hull.is_vertex(2));
  // The smallest extent of this tetrahedron is its height over the slanted face, 1 / sqrt 3.
  EXPECT_NEAR(hull_thickness(hull, points), 1 / std::sqrt(3.0), 1e-15);
}

TEST(SmallHull, AgreesWithExactPredicatesOnRandomPoints) {
  Random random(5);
  SmallHull hull;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) points.push_back((0.7 + 0.3 * random.uniform()) * random.unit_vector());
    ASSERT_TRUE(hull.build(points));
    double volume = 0;
    for (const auto& [a, b, c] : hull_triangles(points))
      volume += dot(points[static_cast<std::size_t>(a)],
                    cross(points[static_cast<std::size_t>(b)], points[static_cast<std::size_t>(c)])) /
                6;
    EXPECT_NEAR(hull.volume(), volume, 1e-13);
  }
}

TEST(SmallHull, FollowsMovingPointsAsIfBuiltAnew) {
  Random random(3);
  for (const double step : {0.003, 0.03, 0.3}) {
    SmallHull followed, built;
    std::vector<Vec3> points;
    for (int i = 0; i < 48; ++i) points.push_back(random.unit_vector());
    ASSERT_TRUE(followed.build(points));
    for (int move = 0; move < 300; ++move) {
      // About a shell, so that points fall inside and come out again.
      for (Vec3& p : points) {
        p += step * random.unit_vector();
        p = ((0.9 * norm(p) + 0.1) / norm(p)) * p;
      }
      ASSERT_TRUE(followed.follow(points));
      ASSERT_TRUE(built.build(points));
      EXPECT_EQ(followed.vertex_count(), built.vertex_count());
      EXPECT_NEAR(followed.volume(), built.volume(), 1e-12);  // rounding of sums of about 100 terms of order one
      for (std::size_t v = 0; v < points.size(); ++v)
        EXPECT_EQ(followed.is_vertex(static_cast<int>(v)), built.is_vertex(static_cast<int>(v)));
    }
  }
}

TEST(SmallHull, RefusesFlatPoints) {
  SmallHull hull;
  EXPECT_FALSE(hull.build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}));
  EXPECT_FALSE(hull.build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(SmallHull, SurvivesNearlyEqualPoints) {
  Random random(9);
  SmallHull hull;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) points.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
    for (int i = 0; i < 40; ++i)
      points.push_back(points[static_cast<std::size_t>(i % 8)] + 1e-15 * random.unit_vector());
    ASSERT_TRUE(hull.build(points));
    EXPECT_NEAR(hull.volume(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace decomposition
