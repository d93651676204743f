// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual rocks on a plate: the plate goes, the rocks come apart, each becomes a solid.
#include "shape_pipeline/floor_plane.h"

#include <gtest/gtest.h>

#include <iostream>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/virtual_parts.h"
#include "shape_pipeline/virtual_scan.h"

namespace shape_pipeline {
namespace {

constexpr double kNoise = 3e-5;  // [m]; a rock is 0.03 m wide

TEST(FloorPlane, IsFoundAndGoes) {
  const VirtualPlate plate = virtual_plate(1, 6000, kNoise);
  const ClearedCloud cleared = without_floor(plate.cloud, "plate.ply");
  // The slope of 3000 points of that noise over 0.08 m is known to 1e-5.
  EXPECT_NEAR(dot(cleared.normal, plate.normal), 1, 1e-8);
  EXPECT_NEAR(cleared.noise, kNoise, 0.1 * kNoise);
  // Five deviations above the plate: of the rock, only a rim at its foot goes.
  EXPECT_GT(cleared.cloud.points.size(), 0.98 * (static_cast<double>(plate.cloud.points.size()) - 3000));
  EXPECT_LT(cleared.cloud.points.size(), plate.cloud.points.size() - 2990);

  const Reconstruction rock = reconstruct_surface(cleared.cloud, {});
  ASSERT_EQ(rock.refusal, "");
  const double error = signed_volume(rock.mesh) / plate.volumes[0] - 1;
  std::cout << "volume error " << 100 * error << " %\n";
  EXPECT_TRUE(mesh_topology(rock.mesh).is_closed());
  // The hidden foot, some 7 % of all directions, is spanned smoothly.
  EXPECT_NEAR(error, 0, 0.02);
}

TEST(FloorPlane, RocksOnItComeApart) {
  const VirtualPlate plate = virtual_plate(4, 3000, kNoise);
  const ClearedCloud cleared = without_floor(plate.cloud, "plate.ply");
  PlateGrains found = separated_grains(cleared.cloud);
  ASSERT_EQ(found.grains.size(), 4u);
  EXPECT_TRUE(found.small.empty());
  std::size_t points = found.specks;
  for (const PointCloud& grain : found.grains) points += grain.points.size();
  EXPECT_EQ(points, cleared.cloud.points.size());
  EXPECT_LT(found.specks, 20u);
  // With a higher limit all are too small, and told so.
  found = separated_grains(cleared.cloud, 5000);
  EXPECT_TRUE(found.grains.empty());
  EXPECT_EQ(found.small.size(), 4u);
}

TEST(FloorPlane, RefusesAPlateWithNothingOnItAndARockWithoutAPlate) {
  const auto refusal = [](const PointCloud& cloud) -> std::string {
    try {
      without_floor(cloud, "plate.ply");
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "";
  };
  PointCloud bare;
  RandomStream random(3);
  for (int i = 0; i < 2000; ++i) bare.points.push_back({random.uniform(), random.uniform(), 1e-3 * random.normal()});
  EXPECT_NE(refusal(bare).find("plate.ply: nothing stands on the plane"), std::string::npos) << refusal(bare);
  EXPECT_NE(refusal(virtual_scan(virtual_rock({}), {})).find("plate.ply: no plane"), std::string::npos)
      << refusal(virtual_scan(virtual_rock({}), {}));
}

}  // namespace
}  // namespace shape_pipeline
