// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/faceted_hull.h"

#include <gtest/gtest.h>

namespace decomposition {
namespace {

TEST(FacetedHull, GridOfPointsIsACubeOfSixSquares) {
  std::vector<Vec3> points;
  for (int i = 0; i < 27; ++i) points.push_back({i % 3 * 0.5, i / 3 % 3 * 0.5, i / 9 * 0.5});
  const Plane top{{0, 0, 1}, 1};
  const auto hull = faceted_hull(points, {top}, 1e-10);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->points.size(), 8u);
  ASSERT_EQ(hull->facets.size(), 6u);
  int on_top = 0;
  for (const Facet& facet : hull->facets) {
    EXPECT_EQ(facet.vertices.size(), 4u);
    on_top += facet.given_plane == 0;
  }
  EXPECT_EQ(on_top, 1);
}

TEST(FacetedHull, RefusesFlatPoints) {
  EXPECT_FALSE(faceted_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}, 1e-10));
}

}  // namespace
}  // namespace decomposition
