// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/target_grain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/shape_descriptors.h"

namespace {

using shape_pipeline::GrainForm;
using shape_pipeline::target_grain;
using shape_pipeline::TargetGrain;

TEST(TargetGrain, HasTheFormAskedForByTheDescriptorsOfEveryShape) {
  for (const GrainForm& form : {GrainForm{4e-4, 0.77, 0.77, 0.91, 0.87}, GrainForm{2e-3, 0.45, 0.6, 0.85, 0.7},
                                GrainForm{1e-4, 0.95, 0.9, 0.965, 0.96}, GrainForm{1e-4, 0.8, 0.75, 0.9, 0.885}}) {
    const TargetGrain grain = target_grain(form, 7);
    EXPECT_TRUE(grain.is_reached());
    const auto measured = shape_pipeline::shape_descriptors(grain.mesh);
    // Size and axes follow from one linear map: rounding alone.
    EXPECT_NEAR(measured.at("equivalent_diameter_volume") / form.diameter, 1, 1e-12);
    EXPECT_NEAR(measured.at("axis_short_inertia") / measured.at("axis_intermediate_inertia"), form.s_over_i, 1e-9);
    EXPECT_NEAR(measured.at("axis_intermediate_inertia") / measured.at("axis_long_inertia"), form.i_over_l, 1e-9);
    EXPECT_NEAR(measured.at("convexity_volume_ratio"), form.convexity, 1e-3);  // as is_reached says
    EXPECT_NEAR(measured.at("sphericity_wadell"), form.sphericity, 1e-3);
    EXPECT_TRUE(shape_pipeline::mesh_topology(grain.mesh).is_closed());
    EXPECT_EQ(shape_pipeline::count_self_intersections(grain.mesh), 0u);
  }
}

TEST(TargetGrain, IsTheSameForASeedAndAnotherForAnother) {
  const GrainForm form{1e-3, 0.7, 0.8, 0.9, 0.87};
  const TargetGrain grain = target_grain(form, 3);
  EXPECT_EQ(grain.mesh.vertices, target_grain(form, 3).mesh.vertices);
  EXPECT_NE(grain.mesh.vertices, target_grain(form, 4).mesh.vertices);
}

TEST(TargetGrain, ComesAsNearAsItCanToWhatNoGrainIs) {
  // Rounder than its ellipsoid: voxel data say so of small grains.
  const TargetGrain round = target_grain({1e-3, 0.5, 0.5, 0.95, 1.03}, 1);
  EXPECT_FALSE(round.is_reached());
  EXPECT_LT(round.sphericity_error, -0.05);
  EXPECT_NEAR(round.convexity_error, 0, 1e-3);
  EXPECT_GT(round.fields, 1);
  // A mesh of an ellipsoid is its own hull.
  EXPECT_NEAR(target_grain({1e-3, 1, 1, 1, 0.995}, 1).convexity_error, 0, 1e-3);
}

TEST(TargetGrain, RefusesFiguresThatNoSolidHas) {
  EXPECT_THROW(target_grain({0, 0.7, 0.8, 0.9, 0.87}, 1), catalog::InputError);
  EXPECT_THROW(target_grain({1e-3, 1.2, 0.8, 0.9, 0.87}, 1), catalog::InputError);
  EXPECT_THROW(target_grain({1e-3, 0.7, 0.8, std::nan(""), 0.87}, 1), catalog::InputError);
}

}  // namespace
