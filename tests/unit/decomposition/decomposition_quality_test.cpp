// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/decomposition_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decomposition/quality/surface_distance.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

catalog::ConvexPart box_part(const catalog::Point& low, const catalog::Point& high) {
  catalog::ConvexPart part;
  part.vertices = solids::box(low, high).vertices;
  const std::vector<std::vector<int>> quads{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int f = 0; f < 6; ++f) {
    catalog::FacePlane plane{};
    const int axis = f / 2;
    plane.normal[axis] = f % 2 ? 1 : -1;
    plane.offset = f % 2 ? high[axis] : -low[axis];
    part.faces.push_back({quads[static_cast<std::size_t>(f)], plane, catalog::FaceKind::outer});
  }
  return part;
}

const catalog::TriangleMesh kCube = solids::box({0, 0, 0}, {1, 1, 1});

TEST(DecompositionQuality, CubeAgainstItself) {
  const catalog::DecompositionError error = measure_error(kCube, {box_part({0, 0, 0}, {1, 1, 1})});
  EXPECT_NEAR(error.symmetric_difference, 0, 1e-12);
  EXPECT_NEAR(error.missing_volume, 0, 1e-12);
  EXPECT_NEAR(error.volume_error, 0, 1e-15);
  EXPECT_NEAR(error.surface.largest, 0, 1e-12);
  EXPECT_NEAR(error.overlap, 0, 1e-12);
}

TEST(DecompositionQuality, ShiftedCube) {
  const double d = 0.1;
  const catalog::DecompositionError error = measure_error(kCube, {box_part({d, 0, 0}, {1 + d, 1, 1})});
  EXPECT_NEAR(error.symmetric_difference, 2 * d, 4 * error.method_error);
  EXPECT_LT(error.method_error, 2e-3);
  EXPECT_GT(error.method_error, 0);
  EXPECT_NEAR(error.missing_volume, d, 4e-3);
  EXPECT_NEAR(error.volume_error, 0, 1e-15);
  // One face across the shift is d away all over, the other min(d, distance to its edge); of each of the four side
  // faces a strip of width d stands out, d / 2 away on average.
  const double facing = (1 - std::pow(1 - 2 * d, 3)) / 6;
  const double mean = (d + facing + 4 * d * d / 2) / 6;
  EXPECT_NEAR(error.surface.largest, d / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(error.surface.mean, mean / std::sqrt(3.0), 0.01 * mean);
  EXPECT_NEAR(error.centre_error, d / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(error.inertia_error, 0, 1e-14);
  EXPECT_NEAR(error.convexity_error, 0, 1e-12);
}

TEST(DecompositionQuality, CubeScaledAboutItsCentre) {
  const double s = 1.1, low = (1 - s) / 2, high = (1 + s) / 2, gap = (s - 1) / 2;
  const catalog::DecompositionError error = measure_error(kCube, {box_part({low, low, low}, {high, high, high})});
  EXPECT_NEAR(error.volume_error, s * s * s - 1, 1e-14);
  EXPECT_NEAR(error.missing_volume, 0, 1e-12);
  EXPECT_NEAR(error.centre_error, 0, 1e-15);
  EXPECT_NEAR(error.inertia_error, std::pow(s, 5) - 1, 1e-13);
  EXPECT_NEAR(error.convexity_error, 0, 1e-12);
  // Every point of the cube is as far from the faces around it; their points are farther off beyond its edges, at
  // most at the corners, which the sample points come near to: 0.02 apart, so that a tenth of the gap may lack.
  const double unit = 1 / std::sqrt(3.0);  // over the diagonal
  EXPECT_NEAR(error.surface_from_mesh.mean, gap * unit, 1e-12);
  EXPECT_NEAR(error.surface_from_mesh.percentile_95, gap * unit, 1e-12);
  EXPECT_NEAR(error.surface_from_mesh.largest, gap * unit, 1e-12);
  EXPECT_GE(error.surface_from_union.percentile_95, error.surface_from_union.mean);
  EXPECT_NEAR(error.surface_from_union.largest, std::sqrt(3.0) * gap * unit, 0.1 * gap * unit);
  EXPECT_EQ(error.surface.largest, error.surface_from_union.largest);
  EXPECT_DOUBLE_EQ(error.surface.mean, (error.surface_from_mesh.mean + error.surface_from_union.mean) / 2);
}

TEST(DecompositionQuality, TurnedInertiaIsAnErrorThoughItsPrincipalMomentsAreNot) {
  // A bar 3 x 1 x 1 against itself laid along y: J is m/12 (b^2 + c^2) on the diagonal, so (2, 10, 10) and (10, 2, 10).
  const catalog::TriangleMesh bar = solids::box({0, 0, 0}, {3, 1, 1});
  const catalog::DecompositionError error = measure_error(bar, {box_part({0, 0, 0}, {1, 3, 1})});
  EXPECT_NEAR(error.inertia_error, std::sqrt(2 * 64.0 / 204), 1e-13);
  EXPECT_NEAR(error.centre_error, std::sqrt(2.0) / std::sqrt(11.0), 1e-13);
}

TEST(DecompositionQuality, ConvexityOfAnLAndOfTheBoxAroundIt) {
  // Volume 3 in a hull of 3.5, against 4 in 4.
  const catalog::DecompositionError error = measure_error(solids::l_shape(), {box_part({0, 0, 0}, {2, 2, 1})});
  EXPECT_NEAR(error.convexity_error, 1 - 3 / 3.5, 1e-12);
  EXPECT_NEAR(error.volume_error, 1.0 / 3, 1e-14);
}

TEST(SurfaceDistance, PercentilesOfOneAndOfTwoSets) {
  std::vector<double> ascending;
  for (int k = 100; k >= 1; --k) ascending.push_back(k);
  const catalog::SurfaceDistance one = summary(ascending, 10);
  EXPECT_DOUBLE_EQ(one.mean, 5.05);
  EXPECT_DOUBLE_EQ(one.percentile_95, 9.5);
  EXPECT_DOUBLE_EQ(one.largest, 10);
  // Half the weight lies at 0, so 90 % of the other set must be passed too.
  const catalog::SurfaceDistance both = summary({0, 0, 0}, ascending, 10);
  EXPECT_DOUBLE_EQ(both.mean, 2.525);
  EXPECT_DOUBLE_EQ(both.percentile_95, 9);
  EXPECT_DOUBLE_EQ(both.largest, 10);
  EXPECT_EQ(summary({}, ascending, 10), one);
  EXPECT_EQ(summary({}, 10), catalog::SurfaceDistance{});
}

TEST(DecompositionQuality, StatedErrorCoversTheTruthForABallInACube) {
  // A ball of radius 1/2 standing for the cube around it: the difference is 1 - V(ball), all of it missing.
  const catalog::TriangleMesh ball = solids::sphere(0.5, 3);
  catalog::ConvexPart part;
  for (const catalog::Point& p : ball.vertices) part.vertices.push_back({p[0] + 0.5, p[1] + 0.5, p[2] + 0.5});
  for (const catalog::Triangle& face : ball.faces)
    part.faces.push_back({{face[0], face[1], face[2]}, {{0, 0, 1}, 1}, catalog::FaceKind::outer});
  const double volume = catalog::volume_moments(ball).volume;
  const catalog::DecompositionError error = measure_error(kCube, {part});
  EXPECT_NEAR(error.symmetric_difference, 1 - volume, 4 * error.method_error + 1e-6);
  EXPECT_NEAR(error.missing_volume, 1 - volume, 4 * error.method_error + 1e-3);
  EXPECT_NEAR(error.volume_error, volume - 1, 1e-12);
  // The cube's corner is farthest from the ball: (sqrt 3 - 1) / 2, over the diagonal sqrt 3.
  EXPECT_NEAR(error.surface.largest, (std::sqrt(3.0) - 1) / 2 / std::sqrt(3.0), 0.01);
}

TEST(DecompositionQuality, CountsOverlap) {
  // [0, 0.6] and [0.4, 1]: sum of volumes 1.2, union 1.
  const catalog::DecompositionError error =
      measure_error(kCube, {box_part({0, 0, 0}, {0.6, 1, 1}), box_part({0.4, 0, 0}, {1, 1, 1})});
  EXPECT_NEAR(error.overlap, 0.2, 3e-3);
  EXPECT_NEAR(error.symmetric_difference, 0, 1e-12);
  EXPECT_NEAR(error.volume_error, 0.2, 1e-12);
}

TEST(DecompositionQuality, FlushInnerFacesAreNoSurface) {
  catalog::ConvexPart left = box_part({0, 0, 0}, {0.5, 1, 1}), right = box_part({0.5, 0, 0}, {1, 1, 1});
  left.faces[1].kind = right.faces[0].kind = catalog::FaceKind::inner;
  const catalog::DecompositionError error = measure_error(kCube, {left, right});
  EXPECT_NEAR(error.surface.largest, 0, 1e-9);
  EXPECT_NEAR(error.symmetric_difference, 0, 1e-12);
}

TEST(DecompositionQuality, SameSeedSameFigures) {
  const std::vector<catalog::ConvexPart> parts{box_part({0.1, 0, 0.02}, {1, 1, 1.03})};
  const catalog::DecompositionError a = measure_error(kCube, parts), b = measure_error(kCube, parts);
  EXPECT_EQ(a.symmetric_difference, b.symmetric_difference);
  EXPECT_EQ(a.surface.mean, b.surface.mean);
}

}  // namespace
}  // namespace decomposition
