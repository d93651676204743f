// SPDX-License-Identifier: GPL-3.0-or-later
// Invariants of digitising on random rocks.
#include <gtest/gtest.h>

#include <cmath>

#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_repair.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/shape_descriptors.h"
#include "tests/support/sample_meshes.h"

namespace shape_pipeline {
namespace {

using test_support::moved;

class RandomRock : public testing::TestWithParam<int> {
 protected:
  catalog::TriangleMesh rock() const {
    const int k = GetParam();
    return virtual_rock({.seed = static_cast<std::uint64_t>(100 + k),
                         .flatness = 0.6 + 0.08 * k,
                         .elongation = 0.95 - 0.08 * k,
                         .notch_depth = k % 2 ? 0.3 : 0.0,
                         .subdivisions = 4});
  }
};

TEST_P(RandomRock, DescriptorsDoNotDependOnPlaceAndTurnAndScaleAsTheirUnit) {
  auto before = shape_descriptors(rock()), after = shape_descriptors(moved(rock(), 3, {0.2, -0.1, 0.4}));
  const std::map<std::string, int> power{{"volume", 3},
                                         {"volume_hull", 3},
                                         {"surface_area", 2},
                                         {"equivalent_diameter_volume", 1},
                                         {"feret_max", 1},
                                         {"mean_edge_length", 1},
                                         {"feret_min", 1},
                                         {"corner_scale", 1},
                                         {"roughness_patch_radius", 1},
                                         {"roughness_sa_iso25178", 1},
                                         {"roughness_sq_iso25178", 1}};
  const auto power_of = [&](const std::string& name) {
    if (const auto entry = power.find(name); entry != power.end()) return entry->second;
    const bool is_length = name.ends_with("_inertia") || name.starts_with("radius_");
    return is_length ? 1 : 0;
  };
  // Of points sampled on the surface along axes of the frame: the spread of that sampling.
  constexpr double kSampling = 0.02;
  for (const auto& [name, value] : before) {
    if (name.find("obb") != std::string::npos || name == "sieve_size_second_axis" || name.find("zingg") == 0 ||
        name.find("kong") != std::string::npos || name.find("krumbein") != std::string::npos)
      continue;  // of the box, which is searched for: below
    const bool is_sampled = name.find("corner_radius") != std::string::npos || name == "corner_area_share";
    const double expected = value * std::pow(3, power_of(name));
    EXPECT_NEAR(after[name], expected, (is_sampled ? kSampling : 1e-8) * (1 + std::abs(expected))) << name;
  }
  // The smallest box is found anew; different minima of nearly equal volume may differ in their sides.
  const double box_before = before["axis_short_obb"] * before["axis_intermediate_obb"] * before["axis_long_obb"];
  const double box_after = after["axis_short_obb"] * after["axis_intermediate_obb"] * after["axis_long_obb"];
  EXPECT_NEAR(box_after / (27 * box_before), 1, 0.02);
}

TEST_P(RandomRock, DescriptorsKeepTheirBounds) {
  auto d = shape_descriptors(rock());
  EXPECT_GT(d["sphericity_wadell"], 0);
  EXPECT_LE(d["sphericity_wadell"], 1);
  EXPECT_LE(d["convexity_volume_ratio"], 1 + 1e-12);
  EXPECT_LE(d["axis_short_obb"], d["axis_intermediate_obb"]);
  EXPECT_LE(d["axis_intermediate_obb"], d["axis_long_obb"]);
  EXPECT_GE(d["axis_short_obb"] * d["axis_intermediate_obb"] * d["axis_long_obb"], d["volume_hull"]);
  EXPECT_GE(d["feret_max"], d["axis_long_obb"] * (1 - 1e-12));
  EXPECT_NEAR(d["compactness_bagi_orosz"] + d["flakiness_bagi_orosz"] + d["rodness_bagi_orosz"], 1, 1e-12);
}

TEST_P(RandomRock, PrincipalFrameKeepsVolumeAndIsCentred) {
  const catalog::TriangleMesh skew = moved(rock(), 1, {1, 2, 3});
  const catalog::ShapeRecord shape = in_principal_frame(skew);
  const catalog::MassProperties again = catalog::mass_properties(shape.mesh);
  EXPECT_NEAR(again.volume, signed_volume(skew), 1e-9 * again.volume);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(again.centroid[i], 0, 1e-9);
    EXPECT_NEAR(again.principal_axes[i][i], 1, 1e-6);
  }
  EXPECT_LE(again.principal_inertia[0], again.principal_inertia[1]);
  EXPECT_LE(again.principal_inertia[1], again.principal_inertia[2]);
}

TEST_P(RandomRock, RepairOfASoundMeshChangesNothing) {
  const catalog::TriangleMesh mesh = rock();
  const RepairedMesh repaired = repair_mesh(mesh, {});
  ASSERT_EQ(repaired.refusal, "");
  EXPECT_EQ(repaired.mesh.faces.size(), mesh.faces.size());
  EXPECT_NEAR(signed_volume(repaired.mesh), signed_volume(mesh), 1e-12 * signed_volume(mesh));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRock, testing::Range(0, 4));

}  // namespace
}  // namespace shape_pipeline
