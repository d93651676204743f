// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/corner_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/virtual_scan.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"

namespace shape_pipeline {
namespace {

using namespace test_support;
using catalog::Point;

/// Share of a Gaussian about x within a box about the origin: a product of error functions.
double share_in_box(const Point& x, const Point& half, double scale) {
  double share = 1;
  for (int i = 0; i < 3; ++i)
    share *= (std::erf((half[i] - x[i]) / (scale * std::numbers::sqrt2)) +
              std::erf((half[i] + x[i]) / (scale * std::numbers::sqrt2))) /
             2;
  return share;
}

TEST(CornerMeasure, SeesThePartOfAGaussianInABox) {
  const Point half{1, 0.8, 1.3};
  const catalog::TriangleMesh box = box_mesh({-1, -0.8, -1.3}, {1, 0.8, 1.3});
  const double scale = 0.2;
  // Middle of a face, of an edge, a corner, and points near them. The midpoint rule with four cells a scale.
  for (const Point& x :
       {Point{1, 0, 0}, Point{1, 0.8, 0}, Point{1, 0.8, 1.3}, Point{1, 0.7, 0.2}, Point{0.9, 0.8, 1.2}})
    EXPECT_NEAR(inside_share(box, x, scale), share_in_box(x, half, scale), 2e-3);
}

TEST(CornerMeasure, SeesASphereAsItsFormulaSays) {
  const catalog::TriangleMesh sphere = uv_sphere(1, 64);
  for (const double scale : {0.1, 0.2, 0.4})  // a chord of the mesh is 1e-3 below the sphere
    EXPECT_NEAR(inside_share(sphere, {0, 0, 1}, scale), inside_share_on_sphere(1, scale), 1e-3 / scale);
  // Of a flat sphere s / (sqrt(2 pi) r) is missing from a half.
  EXPECT_NEAR(inside_share_on_sphere(1e3, 1), 0.5 - 1e-3 / std::sqrt(2 * std::numbers::pi), 1e-9);
}

TEST(CornerMeasure, OfACubeIsTheIntegralOfItsFormula) {
  const double scale = kCornerScale;  // inscribed radius 1
  const auto found = corner_measure(moved(box_mesh({-1, -1, -1}, {1, 1, 1}), 1, {0, 0, 0}), 1);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->scale, scale);
  constexpr int kCells = 60;
  const double flattest = inside_share_on_sphere(1, scale);
  double corners = 0, excess = 0;
  for (int a = 0; a < kCells; ++a)
    for (int b = 0; b < kCells; ++b) {
      const double share = share_in_box({1, (a + 0.5) / kCells, (b + 0.5) / kCells}, {1, 1, 1}, scale);
      if (share >= flattest) continue;
      corners += 1;
      double low = 0, high = 1;
      for (int k = 0; k < 50; ++k)
        (inside_share_on_sphere((low + high) / 2, scale) < share ? low : high) = (low + high) / 2;
      excess += 1 - low;
    }
  // 4000 points spread by area and 60 x 60 over a quarter of a face: a row of either is about 1 % of the area.
  EXPECT_NEAR(found->area_share, corners / (kCells * kCells), 0.015);
  EXPECT_NEAR(found->angularity, excess / (kCells * kCells), 0.01);
  EXPECT_NEAR(found->roundness, 1 - excess / corners, 0.01);
}

TEST(CornerMeasure, OrdersSpherePebbleAndSplinter) {
  const auto of_sphere = corner_measure(uv_sphere(1, 48), 1);
  EXPECT_NEAR(of_sphere->angularity, 0, 0.01);  // the mesh's chords
  RockRecipe rock;
  rock.roughness = 0;
  rock.subdivisions = 4;
  double last = of_sphere->angularity;
  for (const double exponent : {8., 16., 32.}) {
    rock.angularity = exponent;
    const double angularity = shape_descriptors(virtual_rock(rock)).at("angularity_corner_radius");
    EXPECT_GT(angularity, last + 0.01) << exponent;
    last = angularity;
  }
}

TEST(CornerMeasure, OfAPlateIsTheIntegralOfItsFormula) {
  const double thickness = 0.5, scale = kCornerScale * thickness / 2;
  const Point half{1, 1, thickness / 2};
  const auto found = corner_measure(box_mesh({-1, -1, -thickness / 2}, {1, 1, thickness / 2}), thickness / 2);
  ASSERT_TRUE(found);
  const double flattest = inside_share_on_sphere(thickness / 2, scale);
  constexpr int kCells = 200;
  double face = 0, wall = 0;  // shares of corners in a quarter of each
  for (int a = 0; a < kCells; ++a)
    for (int b = 0; b < kCells; ++b) {
      const double u = (a + 0.5) / kCells, v = (b + 0.5) / kCells, one = 1.0 / (kCells * kCells);
      face += share_in_box({u, v, thickness / 2}, half, scale) < flattest ? one : 0;
      wall += share_in_box({1, u, v * thickness / 2}, half, scale) < flattest ? one : 0;
    }
  const double expected = (8 * face + 8 * thickness * wall) / (8 + 8 * thickness);
  EXPECT_NEAR(found->area_share, expected, 0.01);  // 4000 points
}

TEST(CornerMeasure, IsLeftOutOfAThinPlate) {
  EXPECT_FALSE(corner_measure(box_mesh({0, 0, 0}, {1, 1, 0.01}), 0.005));
  EXPECT_EQ(shape_descriptors(box_mesh({0, 0, 0}, {1, 1, 0.01})).count("angularity_corner_radius"), 0u);
}

TEST(CornerMeasure, AndTheOtherDescriptorsHoldUnderRemeshing) {
  RockRecipe rock;
  rock.seed = 7;
  const catalog::TriangleMesh fine = virtual_rock(rock);  // 20480 faces
  const auto before = shape_descriptors(fine);
  for (const std::size_t faces : {8000, 4000}) {
    const RemeshedMesh remeshed = remesh(fine, {faces, RemeshingStyle::isotropic});
    const auto after = shape_descriptors(remeshed.mesh);
    // Half a per cent of what is measured is what the coarser mesh cuts off at its edges.
    for (const char* name : {"radius_inscribed", "radius_enclosing", "feret_min", "feret_max", "axis_long_inertia",
                             "sphericity_wadell", "convexity_volume_ratio"})
      EXPECT_NEAR(after.at(name) / before.at(name), 1, 0.005) << name << " " << faces;
    EXPECT_NEAR(after.at("angularity_corner_radius"), before.at("angularity_corner_radius"), 0.01) << faces;
    EXPECT_NEAR(after.at("roundness_corner_radius"), before.at("roundness_corner_radius"), 0.02) << faces;
  }
}

}  // namespace
}  // namespace shape_pipeline
