// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/convex_polygon.h"

#include <gtest/gtest.h>

namespace decomposition {
namespace {

const Polygon2 kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(ConvexPolygon, IntersectionOfShiftedSquares) {
  const Polygon2 shifted{{0.25, 0.5}, {1.25, 0.5}, {1.25, 1.5}, {0.25, 1.5}};
  EXPECT_DOUBLE_EQ(area(intersection(kSquare, shifted)), 0.75 * 0.5);
  EXPECT_DOUBLE_EQ(area(intersection(kSquare, kSquare)), 1);
}

TEST(ConvexPolygon, DisjointPolygonsHaveNoArea) { EXPECT_EQ(area(intersection(kSquare, {{2, 0}, {3, 0}, {3, 1}})), 0); }

TEST(ConvexPolygon, HullDropsInnerAndCollinearPoints) {
  const std::vector<Point2> points{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.4, 0.6}, {0, 1}, {0.5, 1 + 1e-9}};
  EXPECT_EQ(convex_hull(points, 1e-6), (std::vector<int>{0, 2, 3, 5}));
}

TEST(ConvexPolygon, ClipsATriangleInSpace) {
  const std::vector<Vec3> kept = clip({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {Plane{{1, 0, 0}, 1}});
  ASSERT_EQ(kept.size(), 4u);
  for (const Vec3& p : kept) EXPECT_LE(p.x, 1);
}

}  // namespace
}  // namespace decomposition
