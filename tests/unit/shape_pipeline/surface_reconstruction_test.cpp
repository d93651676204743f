// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surface_reconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/winding_volume.h"
#include "shape_pipeline/virtual_scan.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"

namespace shape_pipeline {
namespace {

using namespace test_support;

const catalog::Check* find_check(const std::vector<catalog::Check>& checks, const std::string& name) {
  const auto check = std::find_if(checks.begin(), checks.end(), [&](const auto& c) { return c.name == name; });
  return check == checks.end() ? nullptr : &*check;
}

void expect_solid(const Reconstruction& reconstruction, double volume, double area, double tolerance,
                  double area_tolerance = 0) {
  if (area_tolerance == 0) area_tolerance = tolerance;
  ASSERT_EQ(reconstruction.refusal, "");
  const MeshTopology topology = mesh_topology(reconstruction.mesh);
  EXPECT_TRUE(topology.is_closed());
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler_number, 2);
  EXPECT_NEAR(signed_volume(reconstruction.mesh), volume, tolerance * volume);
  EXPECT_NEAR(surface_area(reconstruction.mesh), area, area_tolerance * area);
}

TEST(SurfaceReconstruction, OfASampledSphere) {
  const double r = 0.01, pi = std::numbers::pi;
  RandomStream random(3);
  PointCloud cloud;
  for (int i = 0; i < 3000; ++i) cloud.points.push_back(scaled(random.direction(), r));
  const Reconstruction reconstruction = reconstruct_surface(cloud, {});
  expect_solid(reconstruction, 4 * pi / 3 * r * r * r, 4 * pi * r * r, 0.005);
  EXPECT_NE(find_check(reconstruction.checks, "reconstruction_poisson"), nullptr);
  // Given normals that point inwards are turned and used.
  for (const Point& p : cloud.points) cloud.normals.push_back(scaled(p, -1 / r));
  const Reconstruction given = reconstruct_surface(cloud, {});
  expect_solid(given, 4 * pi / 3 * r * r * r, 4 * pi * r * r, 0.005);
  EXPECT_TRUE(find_check(given.checks, "given_normals")->passed);
  // Normals that have nothing to do with the points are not.
  for (Point& normal : cloud.normals) normal = random.direction();
  const Reconstruction random_normals = reconstruct_surface(cloud, {});
  expect_solid(random_normals, 4 * pi / 3 * r * r * r, 4 * pi * r * r, 0.005);
  EXPECT_FALSE(find_check(random_normals.checks, "given_normals")->passed);
}

TEST(SurfaceReconstruction, OfASampledCubeKeepsItsVolume) {
  ScannerFlaws flaws{.seed = 5, .points = 5000, .noise_sigma = 0, .gap_angle = 0, .stray_points = 0};
  const catalog::TriangleMesh cube = moved(box_mesh({0, 0, 0}, {1, 1, 1}), 0.02, {4, 5, 6});
  expect_solid(reconstruct_surface(virtual_scan(cube, flaws), {}), 8e-6, 6 * 4e-4, 0.005,
               0.03);  // the area of the rounded edges is lost
}

TEST(SurfaceReconstruction, OfANotchedRockWithNoiseGapAndStrayPoints) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 11, .notch_depth = 0.35});
  const Reconstruction reconstruction = reconstruct_surface(virtual_scan(rock, {.seed = 2}), {});
  expect_solid(reconstruction, signed_volume(rock), surface_area(rock), 0.01);
  EXPECT_GE(find_check(reconstruction.checks, "removed_outliers")->figure, 4);
}

TEST(SurfaceReconstruction, IsTheSameToTheBit) {
  const PointCloud cloud = virtual_scan(virtual_rock({.seed = 12}), {.seed = 3, .points = 2500});
  for (const ReconstructionMethod method : {ReconstructionMethod::poisson, ReconstructionMethod::alpha_wrap}) {
    ReconstructionOptions options;
    options.method = method;
    const Reconstruction first = reconstruct_surface(cloud, options);
    ASSERT_EQ(first.refusal, "");
    // The second run finds its memory at other addresses: CGAL's sets of handles must not show it.
    std::vector<std::vector<char>> ballast;
    for (int k = 0; k < 3000; ++k) ballast.emplace_back(40 + k * 7919 % 600);
    for (std::size_t k = 0; k < ballast.size(); k += 2) std::vector<char>().swap(ballast[k]);
    const Reconstruction second = reconstruct_surface(cloud, options);
    EXPECT_TRUE(first.mesh.vertices == second.mesh.vertices);
    EXPECT_TRUE(first.mesh.faces == second.mesh.faces);
    for (std::size_t c = 0; c < first.checks.size(); ++c)
      EXPECT_EQ(first.checks[c].figure, second.checks[c].figure) << first.checks[c].name;
  }
}

TEST(SurfaceReconstruction, AlphaWrapStandsInWithinItsVolumeCheck) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 13});
  ReconstructionOptions options;
  options.method = ReconstructionMethod::alpha_wrap;
  const Reconstruction reconstruction = reconstruct_surface(virtual_scan(rock, {.seed = 4}), options);
  expect_solid(reconstruction, signed_volume(rock), surface_area(rock), 0.03);
  EXPECT_NE(find_check(reconstruction.checks, "reconstruction_alpha_wrap"), nullptr);
}

TEST(SurfaceReconstruction, RefusesAHalfScannedRock) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 14});
  const Reconstruction reconstruction =
      reconstruct_surface(virtual_scan(rock, {.seed = 5, .points = 4000, .gap_angle = 1.4, .stray_points = 0}), {});
  EXPECT_TRUE(reconstruction.mesh.faces.empty());
  EXPECT_NE(reconstruction.refusal, "");
}

TEST(WindingVolume, OfMeshesAndOfAHoledOne) {
  const catalog::TriangleMesh box = box_mesh({0, 0, 0}, {1, 0.8, 0.6});
  const catalog::TriangleMesh rock = virtual_rock({.seed = 15, .notch_depth = 0.3});
  EXPECT_NEAR(winding_volume(surface_elements(rock, 4000)), signed_volume(rock), 0.01 * signed_volume(rock));
  catalog::TriangleMesh sphere = uv_sphere(1, 40);
  const double volume = signed_volume(sphere);
  EXPECT_NEAR(winding_volume(surface_elements(sphere, 4000)), volume, 0.01 * volume);
  std::erase_if(sphere.faces, [&](const auto& face) { return sphere.vertices[face[0]][2] > 0.95; });
  EXPECT_NEAR(winding_volume(surface_elements(sphere, 4000)), volume, 0.02 * volume);
}

TEST(WindingVolume, OfSolidsWithFewLargeFaces) {
  const catalog::TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const std::pair<catalog::TriangleMesh, double> solids[] = {{box_mesh({0, 0, 0}, {1, 1, 1}), 1},
                                                             {box_mesh({0, 0, 0}, {1, 0.8, 0.6}), 0.48},
                                                             {box_mesh({0, 0, 0}, {1, 1, 0.1}), 0.1},
                                                             {tetrahedron, 1.0 / 6}};
  for (const auto& [mesh, volume] : solids)
    EXPECT_NEAR(winding_volume(surface_elements(mesh, 4000)), volume, 0.01 * volume) << volume;
}

TEST(SurfaceDistance, IsSignedAndExactOnABox) {
  const catalog::TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const std::vector<double> d = signed_distances_to_surface({{0.5, 0.5, 1.25}, {0.5, 0.4, 0.9}, {2, 2, 0.5}}, box);
  EXPECT_NEAR(d[0], 0.25, 1e-12);
  EXPECT_NEAR(d[1], -0.1, 1e-12);
  EXPECT_NEAR(d[2], std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace shape_pipeline
