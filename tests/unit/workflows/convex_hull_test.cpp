// SPDX-License-Identifier: Apache-2.0
#include "workflows/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "workflows/random_stream.h"

namespace workflows {
namespace {

using catalog::Point;

/// Euler's formula, planes that hold all points, and outward faces.
void expect_convex(const catalog::ConvexPart& part) {
  std::size_t corners = 0;
  for (const catalog::ConvexFace& face : part.faces) {
    corners += face.vertices.size();
    for (const Point& p : part.vertices)
      EXPECT_LE(face.plane.normal[0] * p[0] + face.plane.normal[1] * p[1] + face.plane.normal[2] * p[2],
                face.plane.offset + 1e-9);
  }
  EXPECT_EQ(part.vertex_count() - corners / 2 + part.face_count(), 2u);
  EXPECT_GT(volume_moments(triangulated(part)).volume, 0);
}

std::vector<Point> cube() {
  std::vector<Point> corners;
  for (int c = 0; c < 8; ++c) corners.push_back({double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)});
  return corners;
}

TEST(ConvexHull, CubeHasSixSquares) {
  const catalog::ConvexPart part = convex_hull(cube());
  expect_convex(part);
  ASSERT_EQ(part.face_count(), 6u);
  for (const catalog::ConvexFace& face : part.faces) EXPECT_EQ(face.vertices.size(), 4u);
  EXPECT_NEAR(volume_moments(triangulated(part)).volume, 1, 1e-14);
}

TEST(ConvexHull, PrismOnARegularPolygonHasItsVolume) {
  constexpr int sides = 12;
  std::vector<Point> corners;
  for (int i = 0; i < sides; ++i)
    for (const double z : {0.0, 2.0})
      corners.push_back({std::cos(2 * M_PI * i / sides), std::sin(2 * M_PI * i / sides), z});
  const catalog::ConvexPart part = convex_hull(corners);
  expect_convex(part);
  EXPECT_EQ(part.face_count(), sides + 2u);
  EXPECT_NEAR(volume_moments(triangulated(part)).volume, 2 * sides / 2.0 * std::sin(2 * M_PI / sides), 1e-12);
}

TEST(ConvexHull, RandomPointsOnASphereAreAllCorners) {
  RandomStream random(3);
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i) {
    Point p = random.in_unit_ball<3>();
    const double length = std::hypot(p[0], p[1], p[2]);
    for (double& c : p) c *= 0.01 / length;
    points.push_back(p);
  }
  const catalog::ConvexPart part = convex_hull(points);
  expect_convex(part);
  EXPECT_EQ(part.face_count(), 2 * points.size() - 4);  // triangles only
}

TEST(ConvexHull, RefusesFlatSetsAndInnerPoints) {
  EXPECT_THROW(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), catalog::InputError);
  EXPECT_THROW(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), catalog::InputError);
  std::vector<Point> with_middle = cube();
  with_middle.push_back({0.5, 0.5, 0.5});
  EXPECT_THROW(convex_hull(with_middle), catalog::InputError);
  std::vector<Point> with_edge_point = cube();
  with_edge_point.push_back({0.5, 0, 0});
  EXPECT_THROW(convex_hull(with_edge_point), catalog::InputError);
}

}  // namespace
}  // namespace workflows
