// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/digitization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "catalog/input_error.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surface_distance.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

using namespace test_support;

TEST(PrincipalFrame, OfATurnedBoxHasTheLongAxisAlongX) {
  const catalog::ShapeRecord shape = in_principal_frame(moved(box_mesh({0, 0, 0}, {1, 3, 2}), 0.01, {4, 5, 6}));
  for (const catalog::Point& p : shape.mesh.vertices) {
    EXPECT_NEAR(std::abs(p[0]), 0.015, 1e-9);
    EXPECT_NEAR(std::abs(p[1]), 0.010, 1e-9);
    EXPECT_NEAR(std::abs(p[2]), 0.005, 1e-9);
  }
  EXPECT_NEAR(signed_volume(shape.mesh), 6e-6, 1e-15);  // positive: turned, not mirrored
  // Box of density 1: V (b^2 + c^2) / 12.
  const double v = 6e-6;
  EXPECT_NEAR(shape.mass_properties.principal_inertia[0], v * (4e-4 + 1e-4) / 12, 1e-15);
  EXPECT_NEAR(shape.mass_properties.principal_inertia[1], v * (9e-4 + 1e-4) / 12, 1e-15);
  EXPECT_NEAR(shape.mass_properties.principal_inertia[2], v * (9e-4 + 4e-4) / 12, 1e-15);
}

TEST(Digitization, OfAMeshFileInMillimetresRescaledToASieveSize) {
  const TemporaryFolder folder;
  write_stl(folder / "box.stl", box_mesh({10, 20, 30}, {20, 40, 60}));  // 10 x 20 x 30 mm
  DigitizationOptions options;
  options.metres_per_unit = 1e-3;
  const catalog::ShapeRecord plain = digitize(folder / "box.stl", options);
  EXPECT_NEAR(plain.mass_properties.volume, 6e-6, 1e-11);
  EXPECT_NEAR(plain.descriptors.at("sieve_size_second_axis"), 0.02, 1e-7);
  options.sieve_size = 0.05;
  const catalog::ShapeRecord scaled = digitize(folder / "box.stl", options, ScanTruth{6e-6, 2.2e-3, 0});
  EXPECT_NEAR(scaled.descriptors.at("sieve_size_second_axis"), 0.05, 1e-9);
  EXPECT_NEAR(scaled.mass_properties.volume, 6e-6 * std::pow(2.5, 3), 1e-9);
  EXPECT_NEAR(scaled.descriptors.at("volume_error_truth"), 0, 1e-5);
  const catalog::MassProperties again = catalog::mass_properties(scaled.mesh);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(again.principal_inertia[i], scaled.mass_properties.principal_inertia[i],
                1e-6 * again.principal_inertia[2]);
    EXPECT_NEAR(again.centroid[i], 0, 1e-9);
  }
}

TEST(Digitization, OfAVirtualScanComesNearItsTruth) {
  const TemporaryFolder folder;
  const auto files = write_virtual_scans(folder / "scans", {.count = 2, .seed = 9, .flaws = {}});
  const auto truths = read_truth(folder / "scans" / "truth.json");
  ASSERT_EQ(files.size(), 2u);
  for (const auto& file : files) {
    const catalog::ShapeRecord shape = digitize(file, {}, truths.at(file.filename().string()));
    EXPECT_LT(std::abs(shape.descriptors.at("volume_error_truth")), 0.01) << file;
    EXPECT_LT(std::abs(shape.descriptors.at("surface_area_error_truth")), 0.02) << file;
  }
}

TEST(Digitization, NamesTheFileItRefuses) {
  const TemporaryFolder folder;
  write_stl(folder / "ring.stl", torus(3, 1, 24));
  try {
    digitize(folder / "ring.stl", {});
    FAIL() << "no error";
  } catch (const catalog::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("ring.stl: the mesh cannot be made one right solid"), std::string::npos) << message;
    EXPECT_NE(message.find("--genus"), std::string::npos) << message;
  }
  DigitizationOptions options;
  options.reconstruction.genus = 1;
  EXPECT_NEAR(digitize(folder / "ring.stl", options).mass_properties.volume, signed_volume(torus(3, 1, 24)), 1e-3);
}

TEST(VirtualScan, RocksAreClosedAndNotchedOnesAreNotConvex) {
  const catalog::TriangleMesh plain = virtual_rock({.seed = 3, .roughness = 0, .subdivisions = 4});
  const catalog::TriangleMesh notched =
      virtual_rock({.seed = 3, .roughness = 0, .notch_depth = 0.4, .subdivisions = 4});
  for (const auto* rock : {&plain, &notched}) {
    EXPECT_TRUE(mesh_topology(*rock).is_closed());
    EXPECT_EQ(mesh_topology(*rock).euler_number, 2);
    EXPECT_GT(signed_volume(*rock), 0);
  }
  // Only the notch's Gaussian is taken away, so the volume falls but not by more than a tenth.
  EXPECT_LT(signed_volume(notched), signed_volume(plain));
  EXPECT_GT(signed_volume(notched), 0.85 * signed_volume(plain));
  EXPECT_NE(virtual_rock({.seed = 4}).vertices, virtual_rock({.seed = 5}).vertices);
}

TEST(VirtualScan, HasTheStatedNoiseAndGap) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 3, .roughness = 0.005});
  const ScannerFlaws flaws{.seed = 8, .points = 4000, .noise_sigma = 2e-5, .gap_angle = 0.5, .stray_points = 0};
  const PointCloud cloud = virtual_scan(rock, flaws);
  // The cap of half angle g holds (1 - cos g) / 2 of a sphere's area, on a rock about that.
  const double expected = 4000 * (1 - (1 - std::cos(0.5)) / 2);
  EXPECT_NEAR(static_cast<double>(cloud.points.size()), expected, 0.04 * 4000);
  // The distance to a nearly flat surface is the normal part of the noise.
  double squares = 0;
  for (const double d : signed_distances_to_surface(cloud.points, rock)) squares += d * d;
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(cloud.points.size())), 2e-5, 0.06 * 2e-5);
}

TEST(VirtualScan, FilesAreTheSameToTheByte) {
  const TemporaryFolder folder;
  const auto bytes = [](const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  for (const char* name : {"a", "b"}) write_virtual_scans(folder / name, {.count = 2, .seed = 4, .flaws = {}});
  for (const char* name : {"rock_01.ply", "rock_02.ply", "truth.json"})
    EXPECT_EQ(bytes(folder / "a" / name), bytes(folder / "b" / name)) << name;
}

TEST(Truth, BadFilesAreRefused) {
  const TemporaryFolder folder;
  for (const char* text : {"{", "[]", "{\"scans\": [{\"file\": \"a.ply\", \"volume\": -1, \"surface_area\": 1}]}"}) {
    write_text(folder / "truth.json", text);
    EXPECT_THROW(read_truth(folder / "truth.json"), catalog::InputError) << text;
  }
}

}  // namespace
}  // namespace shape_pipeline
