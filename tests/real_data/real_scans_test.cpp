// SPDX-License-Identifier: GPL-3.0-or-later
// Digitises real scans whose volume and area are known, if they are there.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_topology.h"

namespace shape_pipeline {
namespace {

/// Volume and area are triangle sums of the authors' closed meshes; 0 where no truth exists.
struct RealScan {
  const char* file;
  double metres_per_unit, volume, area;
  bool may_be_refused = false;
};

void PrintTo(const RealScan& scan, std::ostream* out) { *out << scan.file; }

const RealScan kScans[] = {
    {"epfl_stone10_cloud.ply", 1, 2.37457e-4, 2.27391e-2},
    {"epfl_stone14_cloud.ply", 1, 1.70963e-4, 1.78240e-2},
    {"epfl_stone10.stl", 1, 2.37457e-4, 2.27391e-2},
    {"epfl_stone14.stl", 1, 1.70963e-4, 1.78240e-2},
    {"ashlar_1050.obj", 1, 0.135336, 1.98884},
    {"itokawa_radar_25143.tab", 1e3, 0.0240598e9, 0.437404e6},
    // Open, torn and without a known volume: two captures of one stone.
    {"epfl_capture_scanner.stl", 1, 0, 0},
    {"epfl_capture_iphone_lidar.stl", 1, 0, 0},
    // The truth of stone 1 is flawed (inner pieces, Euler number 20).
    {"epfl_stone01.stl", 1, 0, 0, true},
    {"epfl_stone01_cloud.ply", 1, 0, 0, true},
};

class RealScans : public testing::TestWithParam<RealScan> {};

TEST_P(RealScans, BecomeRightSolidsOrAreRefusedByName) {
  const std::filesystem::path path = std::filesystem::path(TALUS_REAL_DATA) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT RUN: no real scan at " << path;
  DigitizationOptions options;
  options.metres_per_unit = GetParam().metres_per_unit;
  catalog::ShapeRecord shape;
  try {
    shape = digitize(path, options);
  } catch (const catalog::InputError& error) {
    ASSERT_TRUE(GetParam().may_be_refused) << error.what();
    EXPECT_EQ(std::string(error.what()).find(path.string()), 0u) << error.what();
    std::cout << "refused: " << error.what() << '\n';
    return;
  }
  const MeshTopology topology = mesh_topology(shape.mesh);
  EXPECT_TRUE(topology.is_closed());
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler_number, 2);
  EXPECT_GT(shape.mass_properties.volume, 0);
  const double volume = signed_volume(shape.mesh), area = surface_area(shape.mesh);
  std::cout << "volume " << volume << " m3, area " << area << " m2, " << shape.mesh.faces.size() << " faces\n";
  if (!(GetParam().volume > 0)) return;
  std::cout << "volume error " << 100 * (volume / GetParam().volume - 1) << " %, area error "
            << 100 * (area / GetParam().area - 1) << " %\n";
  EXPECT_NEAR(volume, GetParam().volume, 0.02 * GetParam().volume);
  EXPECT_NEAR(area, GetParam().area, 0.02 * GetParam().area);
}

INSTANTIATE_TEST_SUITE_P(Files, RealScans, testing::ValuesIn(kScans), [](const auto& instance) {
  std::string name = instance.param.file;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
});

}  // namespace
}  // namespace shape_pipeline
