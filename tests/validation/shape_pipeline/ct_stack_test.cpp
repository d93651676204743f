// SPDX-License-Identifier: GPL-3.0-or-later
// Grains of virtual tomograms against the meshes that these were made of, over the resolution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "catalog/mass_properties.h"
#include "shape_pipeline/ct_stack.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/virtual_stack.h"
#include "tests/support/stack_files.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

/// Bounds of the volume error: what a shift of the surface by 0.05 voxels makes of the volume, 6 * 0.05 / diameter. The
/// bench digitize goes on to 80 voxels.
struct Resolution {
  double diameter;  // [voxels]
  int grains;
  double largest_mean_error;  // of the magnitudes [-]
};

class CtStackResolution : public testing::TestWithParam<Resolution> {};

/// Index of the truth that a grain is: centres within a tenth of the diameter, volumes within a quarter; -1 if none.
int match(const StackGrain& grain, const std::vector<catalog::MassProperties>& truths, double diameter) {
  for (std::size_t t = 0; t < truths.size(); ++t) {
    const catalog::Point& centre = truths[t].centroid;
    const double distance =
        std::hypot(grain.centre[0] - centre[0], grain.centre[1] - centre[1], grain.centre[2] - centre[2]);
    const double error = grain.shape.mass_properties.volume / truths[t].volume - 1;
    if (distance < 0.1 * diameter && std::abs(error) < 0.25) return static_cast<int>(t);
  }
  return -1;
}

TEST_P(CtStackResolution, RecoversTouchingGrainsOneToOne) {
  const test_support::TemporaryFolder folder;
  StackRecipe recipe;
  recipe.diameter = GetParam().diameter;
  recipe.grains = GetParam().grains;
  std::vector<catalog::MassProperties> truths;
  std::vector<double> areas;
  {
    const VirtualStack stack = virtual_stack(stack_grains(recipe.grains - 1, recipe.seed), recipe);
    test_support::write_raw_stack(folder / "pack.raw", stack.volume);
    for (const catalog::TriangleMesh& mesh : stack.truths) {
      truths.push_back(catalog::mass_properties(mesh));
      areas.push_back(surface_area(mesh));
    }
  }
  StackOptions options;
  options.least_diameter = 0.5 * recipe.diameter;
  std::vector<int> found(truths.size(), 0);
  std::vector<double> errors;
  double sum = 0, area_sum = 0;
  const StackSummary summary = digitize_stack(folder / "pack.raw", options, [&](StackGrain&& grain) {
    EXPECT_TRUE(grain.refusal.empty()) << grain.refusal;
    const int t = match(grain, truths, recipe.diameter * recipe.voxel);
    if (t < 0) return;
    ++found[static_cast<std::size_t>(t)];
    errors.push_back(grain.shape.mass_properties.volume / truths[static_cast<std::size_t>(t)].volume - 1);
    sum += std::abs(errors.back());
    area_sum += surface_area(grain.shape.mesh) / areas[static_cast<std::size_t>(t)] - 1;
    EXPECT_TRUE(mesh_topology(grain.shape.mesh).is_closed());
  });
  ASSERT_FALSE(errors.empty());
  const auto matched = static_cast<double>(errors.size());
  const auto one_to_one = std::count(found.begin(), found.end(), 1);
  const auto [low, high] = std::minmax_element(errors.begin(), errors.end());
  std::printf("| %.0f | %td of %zu | %.3f %% | %+.3f to %+.3f %% | %+.2f %% |\n", recipe.diameter, one_to_one,
              truths.size(), 100 * sum / matched, 100 * *low, 100 * *high, 100 * area_sum / matched);
  EXPECT_GE(static_cast<double>(one_to_one), 0.95 * static_cast<double>(truths.size()));
  EXPECT_EQ(summary.grains, truths.size());
  EXPECT_LE(sum / matched, GetParam().largest_mean_error);
}

INSTANTIATE_TEST_SUITE_P(Diameters, CtStackResolution,
                         testing::Values(Resolution{10, 40, 0.03}, Resolution{20, 20, 0.015}),
                         [](const auto& info) { return std::to_string(static_cast<int>(info.param.diameter)); });

}  // namespace
}  // namespace shape_pipeline
