// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/shape_descriptors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape_pipeline/families/spherical_harmonics.h"
#include "shape_pipeline/surfaces/surface_roughness.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"

namespace shape_pipeline {
namespace {

using namespace test_support;
constexpr double pi = std::numbers::pi;

double wadell(double volume, double area) { return std::cbrt(pi) * std::pow(6 * volume, 2.0 / 3) / area; }

TEST(ShapeDescriptors, AreExactOnATurnedBox) {
  const double s = 0.5, i = 0.8, l = 1.3;
  auto d = shape_descriptors(moved(box_mesh({0, 0, 0}, {l, s, i}), 1, {3, -2, 1}));
  const double volume = s * i * l, area = 2 * (s * i + i * l + l * s);
  EXPECT_NEAR(d["volume"], volume, 1e-12);
  EXPECT_NEAR(d["surface_area"], area, 1e-12);
  EXPECT_NEAR(d["volume_hull"], volume, 1e-12);
  EXPECT_NEAR(d["convexity_volume_ratio"], 1, 1e-12);
  EXPECT_NEAR(d["axis_short_obb"], s, 1e-9);
  EXPECT_NEAR(d["axis_intermediate_obb"], i, 1e-9);
  EXPECT_NEAR(d["axis_long_obb"], l, 1e-9);
  EXPECT_NEAR(d["sieve_size_second_axis"], i, 1e-9);
  EXPECT_NEAR(d["zingg_s_over_i"], s / i, 1e-9);
  EXPECT_NEAR(d["zingg_i_over_l"], i / l, 1e-9);
  EXPECT_NEAR(d["sphericity_krumbein_intercept"], std::cbrt(s * i / (l * l)), 1e-9);
  EXPECT_NEAR(d["flatness_kong_fonseca"], (i - s) / i, 1e-9);
  EXPECT_NEAR(d["elongation_kong_fonseca"], (l - i) / l, 1e-9);
  EXPECT_NEAR(d["sphericity_wadell"], wadell(volume, area), 1e-12);
  EXPECT_NEAR(d["equivalent_diameter_volume"], std::cbrt(6 * volume / pi), 1e-12);
  EXPECT_NEAR(d["feret_max"], std::sqrt(s * s + i * i + l * l), 1e-12);
  // The orientation tensor's eigenvalues are the areas across each axis.
  EXPECT_NEAR(d["sphericity_sneed_folk"], std::cbrt(s * s / (l * i)), 1e-9);
  EXPECT_NEAR(d["shape_factor_corey"], s / std::sqrt(l * i), 1e-9);
  EXPECT_NEAR(d["flatness_potticary"], 2 * (i - s) / (s + i + l), 1e-9);
  EXPECT_NEAR(d["elongation_potticary"], (l - i) / (s + i + l), 1e-9);
  EXPECT_NEAR(d["flatness_angelidakis"], i * i / (s * l + i * i) - s / (s + l), 1e-9);
  EXPECT_NEAR(d["elongation_angelidakis"], s * l / (s * l + i * i) - s / (s + l), 1e-9);
  EXPECT_NEAR(d["feret_min"], s, 1e-12);
  EXPECT_NEAR(d["radius_inscribed"], s / 2, 1e-9);
  EXPECT_NEAR(d["radius_enclosing"], std::sqrt(s * s + i * i + l * l) / 2, 1e-9);
  EXPECT_NEAR(d["sphericity_inscribed_enclosing"], s / std::sqrt(s * s + i * i + l * l), 1e-8);
  // Of a box of side b the integral of x^2 is V b^2 / 12.
  EXPECT_NEAR(d["axis_short_inertia"], s * std::sqrt(5.0 / 3), 1e-9);
  EXPECT_NEAR(d["axis_intermediate_inertia"], i * std::sqrt(5.0 / 3), 1e-9);
  EXPECT_NEAR(d["axis_long_inertia"], l * std::sqrt(5.0 / 3), 1e-9);
  const double f1 = i * l, f2 = l * s, f3 = s * i;
  EXPECT_NEAR(d["compactness_bagi_orosz"], f3 / f1, 1e-12);
  EXPECT_NEAR(d["flakiness_bagi_orosz"], (f1 - f2) / f1, 1e-12);
  EXPECT_NEAR(d["rodness_bagi_orosz"], (f2 - f3) / f1, 1e-12);
  EXPECT_EQ(d["face_count"], 12);
  // 12 box edges and 6 face diagonals.
  const double edges = 4 * (s + i + l) + 2 * (std::hypot(s, i) + std::hypot(i, l) + std::hypot(l, s));
  EXPECT_NEAR(d["mean_edge_length"], edges / 18, 1e-12);
}

TEST(ShapeDescriptors, OfTheTetrahedron) {
  const double a = 2;
  auto d = shape_descriptors(moved(tetrahedron(a), 1, {0, 0, 5}));
  EXPECT_NEAR(d["volume"], a * a * a / (6 * std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(d["surface_area"], std::sqrt(3.0) * a * a, 1e-12);
  EXPECT_NEAR(d["sphericity_wadell"], wadell(a * a * a / (6 * std::sqrt(2.0)), std::sqrt(3.0) * a * a), 1e-12);
  EXPECT_NEAR(d["compactness_bagi_orosz"], 1, 1e-9);
  EXPECT_NEAR(d["feret_max"], a, 1e-12);
  EXPECT_NEAR(d["feret_min"], a / std::sqrt(2.0), 1e-12);  // between opposite edges
  EXPECT_NEAR(d["radius_inscribed"], a / (2 * std::sqrt(6.0)), 1e-9);
  EXPECT_NEAR(d["radius_enclosing"], a * std::sqrt(6.0) / 4, 1e-9);
  // The smallest box is the cube whose face diagonals are the edges.
  for (const char* axis : {"axis_short_obb", "axis_intermediate_obb", "axis_long_obb"})
    EXPECT_NEAR(d[axis], a / std::sqrt(2.0), 1e-3 * a) << axis;
}

TEST(ShapeDescriptors, OfTheOctahedron) {
  const double a = 1.5, volume = std::sqrt(2.0) / 3 * a * a * a, area = 2 * std::sqrt(3.0) * a * a;
  auto d = shape_descriptors(moved(octahedron(a), 1, {1, 0, 0}));
  EXPECT_NEAR(d["volume"], volume, 1e-12);
  EXPECT_NEAR(d["surface_area"], area, 1e-12);
  EXPECT_NEAR(d["sphericity_wadell"], wadell(volume, area), 1e-12);
  EXPECT_NEAR(d["feret_max"], a * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(d["feret_min"], a * std::sqrt(2.0 / 3), 1e-12);  // between opposite faces
  EXPECT_NEAR(d["radius_inscribed"], a / std::sqrt(6.0), 1e-9);
  EXPECT_NEAR(d["sphericity_inscribed_enclosing"], 1 / std::sqrt(3.0), 1e-8);
}

TEST(ShapeDescriptors, OfFinerSpheresTendToOneWithTheSquareOfTheEdge) {
  auto coarse = shape_descriptors(uv_sphere(1, 16)), fine = shape_descriptors(uv_sphere(1, 32));
  EXPECT_LT(coarse["sphericity_wadell"], 1);
  EXPECT_NEAR((1 - coarse["sphericity_wadell"]) / (1 - fine["sphericity_wadell"]), 4, 0.2);
  EXPECT_NEAR((4 * pi / 3 - coarse["volume"]) / (4 * pi / 3 - fine["volume"]), 4, 0.1);
  EXPECT_NEAR(fine["feret_max"], 2, 1e-12);
  EXPECT_NEAR(fine["axis_short_obb"], 2, 0.02);
  EXPECT_NEAR(fine["convexity_volume_ratio"], 1, 1e-9);
}

TEST(ShapeDescriptors, ConvexityOfANotchedBlock) {
  // An L: the unit square prism of 2 x 2 x 1 without one quarter. The hull cuts the notch by a diagonal.
  const catalog::TriangleMesh ell{{{0, 0, 0},
                                   {2, 0, 0},
                                   {2, 1, 0},
                                   {1, 1, 0},
                                   {1, 2, 0},
                                   {0, 2, 0},
                                   {0, 0, 1},
                                   {2, 0, 1},
                                   {2, 1, 1},
                                   {1, 1, 1},
                                   {1, 2, 1},
                                   {0, 2, 1}},
                                  {{0, 3, 1},   {1, 3, 2},  {0, 5, 3},  {3, 5, 4},   {6, 7, 9}, {7, 8, 9}, {6, 9, 11},
                                   {9, 10, 11}, {0, 1, 7},  {0, 7, 6},  {1, 2, 8},   {1, 8, 7}, {2, 3, 9}, {2, 9, 8},
                                   {3, 4, 10},  {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}}};
  auto d = shape_descriptors(moved(ell, 1, {0, 0, 0}));
  EXPECT_NEAR(d["volume"], 3, 1e-12);
  EXPECT_NEAR(d["volume_hull"], 3.5, 1e-12);
  EXPECT_NEAR(d["convexity_volume_ratio"], 3 / 3.5, 1e-12);
  EXPECT_NEAR(d["radius_inscribed"], 0.5, 1e-9);  // the height of 1 holds it in the inner corner
  EXPECT_NEAR(d["feret_min"], 1, 1e-12);
}

/// A slab of n by n squares cut in two on either side, z = +-(1 + e sin kx sin ky), closed by four walls.
catalog::TriangleMesh wavy_slab(int n, double width, double e, double k) {
  catalog::TriangleMesh mesh;
  for (const double side : {1.0, -1.0})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double x = width * i / n, y = width * j / n;
        mesh.vertices.push_back({x, y, side * (1 + e * std::sin(k * x) * std::sin(k * y))});
      }
  const auto at = [n](int side, int i, int j) { return (side * (n + 1) + i) * (n + 1) + j; };
  const auto add = [&](int a, int b, int c, int d) {
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      add(at(0, i, j), at(0, i + 1, j), at(0, i + 1, j + 1), at(0, i, j + 1));
      add(at(1, i, j), at(1, i, j + 1), at(1, i + 1, j + 1), at(1, i + 1, j));
    }
  for (int i = 0; i < n; ++i) {
    add(at(1, i, 0), at(1, i + 1, 0), at(0, i + 1, 0), at(0, i, 0));
    add(at(1, i + 1, n), at(1, i, n), at(0, i, n), at(0, i + 1, n));
    add(at(1, 0, i + 1), at(1, 0, i), at(0, 0, i), at(0, 0, i + 1));
    add(at(1, n, i), at(1, n, i + 1), at(0, n, i + 1), at(0, n, i));
  }
  return mesh;
}

// Means of s = sin kx sin ky: s^2 1/4, s^4 9/64, |s| 4 / pi^2, |grad s|^2 k^2 / 2. Six waves in a patch lose some per
// cent to its polynomial.
TEST(SurfaceRoughness, OfAWaveIsThatOfItsFormulas) {
  const double e = 0.01, k = 6 * pi;
  const auto found = surface_roughness(wavy_slab(180, 8, e, k), 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->sq, e / 2, 0.03 * e / 2);
  EXPECT_NEAR(found->sa, 4 * e / (pi * pi), 0.03 * 4 * e / (pi * pi));
  EXPECT_NEAR(found->sdq, e * k / std::sqrt(2.0), 0.05 * e * k / std::sqrt(2.0));
  EXPECT_NEAR(found->sku, 2.25, 0.1);
  EXPECT_NEAR(found->ssk, 0, 0.1);
}

TEST(SurfaceRoughness, FormAndRidgesAreNone) {
  const auto sphere = surface_roughness(uv_sphere(1, 120), 0.2);
  ASSERT_TRUE(sphere);
  EXPECT_LT(sphere->sq, 1.5 * 0.03 * std::pow(0.2, 4));
  auto box = shape_descriptors(moved(box_mesh({0, 0, 0}, {1, 1, 1}), 1, {3, -2, 1}));
  EXPECT_NEAR(box["roughness_sq_iso25178"], 0, 1e-12);
  EXPECT_NEAR(box["roughness_sdq_iso25178"], 0, 1e-12);
  EXPECT_NEAR(box["roughness_patch_radius"], 0.1, 1e-9);
}

// Halving slender faces keeps them few: quartering them took gigabytes.
TEST(SurfaceRoughness, SlenderFacesAreNoMatter) {
  catalog::TriangleMesh rod = uv_sphere(1, 16);
  for (auto& p : rod.vertices) p = {p[0], p[1], p[2] > 0 ? 20.0 : -20.0};
  std::erase_if(rod.faces, [&](const catalog::Triangle& face) {
    return rod.vertices[face[0]] == rod.vertices[face[1]] || rod.vertices[face[1]] == rod.vertices[face[2]] ||
           rod.vertices[face[2]] == rod.vertices[face[0]];
  });
  const auto found = surface_roughness(rod, 0.25);
  ASSERT_TRUE(found);
  EXPECT_LT(found->sq, 1e-2);
}

/// The unit sphere with the radius 1 + e P_3(z).
catalog::TriangleMesh pear(double e, int rings) {
  catalog::TriangleMesh mesh = uv_sphere(1, rings);
  for (auto& p : mesh.vertices) {
    const double r = 1 + e * (5 * p[2] * p[2] * p[2] - 3 * p[2]) / 2;
    for (double& x : p) x *= r;
  }
  return mesh;
}

// Y_30 = sqrt(7 / 4 pi) P_3, so that a_30 = e sqrt(4 pi / 7); what is left is the facets' share.
TEST(HarmonicAmplitudes, OfOneHarmonicAreThatOneInAnyAttitude) {
  for (const catalog::TriangleMesh& mesh : {pear(0.05, 60), moved(pear(0.05, 60), 1, {0, 0, 0})}) {
    const std::vector<double> d = harmonic_amplitudes(mesh, 15);
    ASSERT_EQ(d.size(), 16u);
    EXPECT_NEAR(d[0], std::sqrt(4 * pi), 1e-3 * d[0]);
    EXPECT_NEAR(d[3] / d[0], 0.05 / std::sqrt(7.0), 1e-4);
    for (const std::size_t n : {1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}) EXPECT_LT(d[n] / d[0], 1e-3) << n;
  }
}

TEST(HarmonicAmplitudes, OfACubeAreThoseOfItsSymmetry) {
  const std::vector<double> coarse = harmonic_amplitudes(box_mesh({-1, -1, -1}, {1, 1, 1}), 15);
  for (int n = 1; n < 16; n += 2) EXPECT_NEAR(coarse[n], 0, 1e-6 * coarse[0]) << n;
  EXPECT_NEAR(coarse[2], 0, 1e-6 * coarse[0]);
  EXPECT_GT(coarse[4], 0.05 * coarse[0]);
}

TEST(ShapeDescriptors, OnlyStarShapedSolidsHaveHarmonics) {
  EXPECT_TRUE(shape_descriptors(uv_sphere(1, 12)).contains("harmonic_d02_over_d00_garboczi"));
  EXPECT_FALSE(shape_descriptors(torus(3, 1, 12)).contains("harmonic_d02_over_d00_garboczi"));
}

}  // namespace
}  // namespace shape_pipeline
