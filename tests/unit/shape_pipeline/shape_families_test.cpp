// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/shape_families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/built_in_solids.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/virtual_scan.h"
#include "tests/support/sample_meshes.h"

namespace shape_pipeline {
namespace {

catalog::TriangleMesh solid(const std::string& name, const std::map<std::string, double>& parameters = {}) {
  return built_in_solid({name, parameters, 1}).mesh;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ShapeFamilies, StretchToTheRatiosAskedAtConstantVolume) {
  for (const char* name : {"crushed-rock", "cube", "hexapod"}) {
    const catalog::TriangleMesh mesh = solid(name);
    const FamilyMember member = stretched(mesh, 0.55, 0.7);
    auto d = shape_descriptors(member.mesh);
    EXPECT_NEAR(d["zingg_s_over_i"], 0.55, 1e-6) << name;
    EXPECT_NEAR(d["zingg_i_over_l"], 0.7, 1e-6) << name;
    EXPECT_NEAR(d["volume"] / signed_volume(mesh), 1, 1e-12) << name;
    EXPECT_EQ(stretched(mesh, 0.55, 0.7).mesh.vertices, member.mesh.vertices) << name;
  }
}

TEST(ShapeFamilies, RoundAndSharpenToTheAngularityAskedAtConstantVolume) {
  const catalog::TriangleMesh dice = solid("dice", {{"rounding", 0.3}, {"detail", 8}});
  const double own = shape_descriptors(dice).at("angularity_corner_radius");
  for (const double target : {0.7 * own, 1.1 * own}) {
    const FamilyMember member = with_angularity(dice, target, 0.005);
    EXPECT_NEAR(shape_descriptors(member.mesh).at("angularity_corner_radius"), target, 0.005);
    EXPECT_NEAR(signed_volume(member.mesh) / signed_volume(dice), 1, 1e-12);
    EXPECT_EQ(count_self_intersections(member.mesh), 0u);
  }
  EXPECT_NE(refusal([&] { with_angularity(dice, 0.9, 0.005); }).find("the nearest is"), std::string::npos);
}

TEST(ShapeFamilies, FlatterAndDeeperHollowsToTheConvexityAskedAtConstantVolume) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 7, .notch_depth = 0.3});
  const double own = shape_descriptors(rock).at("convexity_volume_ratio");
  for (const double target : {own - 0.05, (1 + own) / 2}) {
    const FamilyMember member = with_convexity(rock, target, 0.002);
    auto d = shape_descriptors(member.mesh);
    EXPECT_NEAR(d["convexity_volume_ratio"], target, 0.002);
    EXPECT_NEAR(d["volume"] / signed_volume(rock), 1, 1e-12);
    EXPECT_EQ(count_self_intersections(member.mesh), 0u);
    EXPECT_EQ(with_convexity(rock, target, 0.002).mesh.vertices, member.mesh.vertices);
  }
  EXPECT_NE(refusal([&] { with_convexity(solid("cube"), 0.8, 0.005); }).find("the nearest is 0.99"), std::string::npos);
  EXPECT_NE(refusal([&] { with_convexity(rock, 1.2, 0.005); }).find("at most 1"), std::string::npos);
}

TEST(ShapeFamilies, HarmonicsLeaveWhatIsOfLowDegreeAsItIs) {
  // r = 1 + 0.2 z + 0.1 (3 z^2 - 1) has degree 2.
  catalog::TriangleMesh mesh = test_support::uv_sphere(1, 16);
  for (catalog::Point& p : mesh.vertices) {
    const double r = 1 + 0.2 * p[2] + 0.1 * (3 * p[2] * p[2] - 1);
    for (double& x : p) x *= r;
  }
  EXPECT_LT(low_passed(mesh, 2).checks.at(0).figure, 1e-12);
  EXPECT_GT(low_passed(mesh, 1).checks.at(0).figure, 1e-2);
  EXPECT_EQ(low_passed(mesh, 2).checks.at(0).name, "low_pass_spherical_harmonics");
}

TEST(ShapeFamilies, ATaubinFilterTakesWhatIsNotStarShaped) {
  const catalog::TriangleMesh ring = solid("ring", {{"detail", 12}});
  EXPECT_FALSE(is_star_shaped(ring));
  const FamilyMember member = low_passed(ring, 12);
  EXPECT_EQ(member.checks.at(0).name, "low_pass_taubin");
  EXPECT_EQ(mesh_topology(member.mesh).euler_number, 0);
  EXPECT_NEAR(signed_volume(member.mesh) / signed_volume(ring), 1, 1e-12);
  EXPECT_LT(member.checks.at(0).figure, 0.02);  // a ring has no detail finer than its tube
}

TEST(ShapeFamilies, RefuseByName) {
  const catalog::TriangleMesh cube = solid("cube");
  EXPECT_NE(refusal([&] { stretched(cube, 1.2, 0.5); }).find("S/I: expected a ratio of 0.01 to 1"), std::string::npos);
  EXPECT_NE(refusal([&] { stretched(cube, 0.5, 0); }).find("I/L"), std::string::npos);
  EXPECT_NE(refusal([&] { low_passed(cube, 31); }).find("expected 1 to 30"), std::string::npos);
  EXPECT_NE(refusal([&] { low_passed(cube, 5); }).find("only 8 vertices"), std::string::npos);
  EXPECT_NE(refusal([&] { with_angularity(cube, 1.5, 0.01); }).find("expected 0 to 1"), std::string::npos);
}

}  // namespace
}  // namespace shape_pipeline
