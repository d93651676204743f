// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of several bodies: each is divided as well as it would be alone, wherever it lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catalog/input_error.h"
#include "decomposition/convex_decomposition.h"
#include "decomposition/decomposition_quality.h"
#include "tests/support/partition_checks.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

using catalog::Point;
using catalog::TriangleMesh;
using partition_checks::expect_partition;

constexpr double kATenth = 1.1;  // what an error may be of that of a body alone: another search, other noise

TriangleMesh ball(double radius, const Point& centre) { return solids::moved(solids::sphere(radius, 4), centre); }

TriangleMesh two_balls(double radius, double apart) {
  return solids::together({ball(radius, {0, 0, 0}), ball(radius, {apart, 0, 0})});
}

DecompositionOptions quick(int parts) {
  DecompositionOptions options;
  options.parts = parts;
  options.effort = 0.1;
  return options;
}

double error_alone(int parts) { return decompose(ball(1, {0, 0, 0}), quick(parts)).error.symmetric_difference; }

/// Middle of a part's corners.
Point middle(const catalog::ConvexPart& part) {
  Point sum{};
  for (const Point& p : part.vertices)
    for (std::size_t i = 0; i < 3; ++i) sum[i] += p[i] / static_cast<double>(part.vertex_count());
  return sum;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

std::string refusal(const TriangleMesh& mesh, int parts) {
  try {
    decompose(mesh, quick(parts));
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SeparateBodies, BallsAreDividedAsWellAsOneAtAnyDistance) {
  const double one = error_alone(1), four = error_alone(4);
  for (const double apart : {2.5, 12.0, 100.0}) {
    const catalog::LevelOfDetail pair = decompose(two_balls(1, apart), quick(2));
    expect_partition(pair);
    EXPECT_EQ(pair.parts.size(), 2u);
    EXPECT_LT(pair.error.symmetric_difference, kATenth * one) << apart;
    EXPECT_LT(pair.error.method_error, 1e-3) << apart << ": traced ball by ball";
  }
  const catalog::LevelOfDetail eight = decompose(two_balls(1, 30), quick(8));
  expect_partition(eight);
  EXPECT_LT(eight.error.symmetric_difference, kATenth * four);
}

TEST(SeparateBodies, TheirSizeAndDistanceAreNoSignOfFlatness) {
  const double one = error_alone(1);
  for (const double apart : {6e-6, 1e-2})
    EXPECT_LT(decompose(two_balls(1e-6, apart), quick(2)).error.symmetric_difference, kATenth * one) << apart;
  EXPECT_LT(decompose(two_balls(1, 1000), quick(2)).error.symmetric_difference, kATenth * one);
}

TEST(SeparateBodies, EachOfUnequalOnesHasAPart) {
  const std::vector<std::pair<double, Point>> bodies{
      {1, {0, 0, 0}}, {0.7, {4, 1, 0}}, {0.5, {2, 9, 3}}, {0.6, {-3, 4, 8}}, {0.8, {20, -4, 3}}};
  std::vector<TriangleMesh> meshes;
  for (const auto& [radius, centre] : bodies) meshes.push_back(ball(radius, centre));
  for (const int parts : {5, 8}) {
    const catalog::LevelOfDetail level = decompose(solids::together(meshes), quick(parts));
    expect_partition(level);
    EXPECT_EQ(level.parts.size(), static_cast<std::size_t>(parts));
    EXPECT_LT(level.error.symmetric_difference, kATenth * error_alone(1));
    for (const auto& [radius, centre] : bodies)
      EXPECT_TRUE(std::any_of(level.parts.begin(), level.parts.end(), [&, r = radius, c = centre](const auto& part) {
        return distance(middle(part), c) < r;
      })) << radius;
  }
}

TEST(SeparateBodies, FewerPartsThanBodiesSpanThemOrAreRefused) {
  const TriangleMesh row = solids::together({ball(1, {0, 0, 0}), ball(0.7, {4, 0, 0}), ball(0.5, {9, 0, 0})});
  for (const int parts : {1, 2}) {
    const std::string message = parts == 1 ? refusal(row, 1) : refusal(two_balls(1, 30), 1);
    EXPECT_NE(message.find(parts == 1 ? "3 bodies" : "2 bodies"), std::string::npos) << message;
    EXPECT_NE(message.find(parts == 1 ? "at least 3 parts" : "at least 2 parts"), std::string::npos) << message;
    EXPECT_NE(message.find("its 1 part differs"), std::string::npos) << message;
  }
  EXPECT_EQ(decompose(two_balls(1, 2.1), quick(1)).parts.size(), 1u);
}

TEST(SeparateBodies, EachOfManyEqualOnesHasAPart) {
  std::vector<TriangleMesh> balls;
  for (int i = 0; i < 80; ++i)
    balls.push_back(solids::moved(solids::sphere(1, 1), {3.0 * (i % 4), 3.0 * (i / 4 % 4), 3.0 * (i / 16)}));
  const TriangleMesh heap = solids::together(balls);
  const catalog::LevelOfDetail level = decompose(heap, quick(80));
  EXPECT_EQ(level.parts.size(), 80u);
  EXPECT_LT(level.error.symmetric_difference, 1e-9);  // convex: their own hulls
  const std::string message = refusal(heap, 2);
  EXPECT_NE(message.find("80 bodies"), std::string::npos) << message;
}

TEST(SeparateBodies, NearOrInterlockedOnesAreStillAPartition) {
  const TriangleMesh ring = solids::torus(1, 0.25, 24, 12);
  TriangleMesh link = solids::moved(ring, {1, 0, 0});
  for (Point& p : link.vertices) p = {p[0], p[2], -p[1]};
  const TriangleMesh chain = solids::together({ring, link});
  for (const int parts : {2, 8}) expect_partition(decompose(chain, quick(parts)));
  const catalog::LevelOfDetail touching =
      decompose(solids::together({solids::box({0, 0, 0}, {1, 1, 1}), solids::box({1, 0, 0}, {2, 2, 2})}), quick(2));
  expect_partition(touching);
  EXPECT_LT(touching.error.symmetric_difference, 0.05);  // their faces make no re-entrant edges to cut along
  const catalog::LevelOfDetail near = decompose(two_balls(1, 2.02), quick(2));
  expect_partition(near);
  EXPECT_LT(near.error.symmetric_difference, 0.06);  // a twentieth of a ball and what the cut between them costs
}

TEST(SeparateBodies, BoundsHoldForEach) {
  DecompositionOptions options = quick(2);
  options.mode = FitMode::enclosing;
  EXPECT_LT(decompose(two_balls(1, 6), options).error.missing_volume, 1e-9);
  options.mode = FitMode::inscribed;
  const catalog::LevelOfDetail inscribed = decompose(two_balls(1, 6), options);
  EXPECT_EQ(inscribed.parts.size(), 2u);
  EXPECT_NEAR(inscribed.error.symmetric_difference, inscribed.error.missing_volume, 1e-4);
}

TEST(SeparateBodies, ErrorsOfBodiesFarApartAreMeasuredOneByOne) {
  const double side = 0.9;
  const auto cubes = [](double edge) {
    return solids::together(
        {solids::box({0, 0, 0}, {edge, edge, edge}), solids::box({500, 0, 0}, {500 + edge, edge, edge})});
  };
  const std::vector<catalog::ConvexPart> small = decompose(cubes(side), quick(2)).parts;
  ASSERT_EQ(small.size(), 2u);
  const catalog::DecompositionError error = measure_error(cubes(1), small);
  const double missing = 1 - side * side * side;
  EXPECT_NEAR(error.symmetric_difference, missing, 5e-4);  // rays: 4 bundles of 192 x 192
  EXPECT_NEAR(error.missing_volume, missing, 5e-4);
  EXPECT_NEAR(error.overlap, 0, 1e-12);
}

}  // namespace
}  // namespace decomposition
