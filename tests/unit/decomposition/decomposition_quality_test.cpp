// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/decomposition_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
  EXPECT_NEAR(error.surface_max, 0, 1e-12);
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
  EXPECT_NEAR(error.surface_max, d / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(error.surface_mean, mean / std::sqrt(3.0), 0.01 * mean);
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
  EXPECT_NEAR(error.surface_max, (std::sqrt(3.0) - 1) / 2 / std::sqrt(3.0), 0.01);
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
  EXPECT_NEAR(error.surface_max, 0, 1e-9);
  EXPECT_NEAR(error.symmetric_difference, 0, 1e-12);
}

TEST(DecompositionQuality, SameSeedSameFigures) {
  const std::vector<catalog::ConvexPart> parts{box_part({0.1, 0, 0.02}, {1, 1, 1.03})};
  const catalog::DecompositionError a = measure_error(kCube, parts), b = measure_error(kCube, parts);
  EXPECT_EQ(a.symmetric_difference, b.symmetric_difference);
  EXPECT_EQ(a.surface_mean, b.surface_mean);
}

}  // namespace
}  // namespace decomposition
