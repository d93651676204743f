// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of virtual rocks, turned and shifted at random: where do they come to lie?
#include "shape_pipeline/registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numbers>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/solid_alignment.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/virtual_parts.h"
#include "shape_pipeline/virtual_scan.h"

namespace shape_pipeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNoise = 3e-5;  // [m]; a rock is 0.03 m wide

catalog::TriangleMesh rock(std::uint64_t seed) {
  RockRecipe recipe;
  recipe.seed = seed;
  recipe.flatness = 0.75;
  recipe.notch_depth = seed % 2 == 0 ? 0.3 : 0;
  return virtual_rock(recipe);
}

class Registrations : public testing::TestWithParam<int> {};

TEST_P(Registrations, BringThePartsOfARockTogether) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const catalog::TriangleMesh mesh = rock(seed);
  const VirtualParts scans = virtual_parts(mesh, 3, seed, kNoise);
  const RegisteredParts found = register_parts(scans.parts);
  const PoseError error = worst_pose_error(found, scans);
  for (const catalog::Check& check : found.checks)
    std::cout << check.name << ' ' << check.figure << ' ' << check.detail << '\n';
  std::cout << "rotation " << error.rotation / kDegree << " degrees, shift " << 100 * error.shift
            << " % of the diagonal\n";
  // At 0.5 degrees the seam of two parts stands off by 0.4 % of the diagonal, half a face of a mesh of 10000.
  EXPECT_LT(error.rotation, 0.5 * kDegree);
  EXPECT_LT(error.shift, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Rocks, Registrations, testing::Range(1, 4));

TEST(Registration, IsTheSameOnEveryCall) {
  const VirtualParts scans = virtual_parts(rock(2), 2, 5, kNoise);
  const RegisteredParts once = register_parts(scans.parts), again = register_parts(scans.parts);
  EXPECT_EQ(once.merged.points, again.merged.points);
}

std::string refusal(const std::vector<PartialScan>& parts) {
  try {
    register_parts(parts);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Registration, RefusesOnePartOtherUnitsAndAnotherRock) {
  const VirtualParts scans = virtual_parts(rock(1), 2, 1, kNoise);
  EXPECT_NE(refusal({scans.parts[0]}).find("part1.ply: registration needs two"), std::string::npos);
  std::vector<PartialScan> mixed = scans.parts;
  for (Point& point : mixed[1].cloud.points) point = scaled(point, 1000);
  EXPECT_NE(refusal(mixed).find("part2.ply is 1"), std::string::npos) << refusal(mixed);
  const std::vector<PartialScan> strangers{scans.parts[0], virtual_parts(rock(2), 2, 3, kNoise).parts[1]};
  EXPECT_NE(refusal(strangers).find("part2.ply: does not fit the other parts"), std::string::npos)
      << refusal(strangers);
}

TEST(SolidAlignment, FindsTheMotionOfATurnedRock) {
  const catalog::TriangleMesh mesh = rock(4);
  const RigidMotion motion{{{{0.48, -0.8, 0.36}, {0.6, 0, -0.8}, {0.64, 0.6, 0.48}}}, {0.1, -0.05, 0.02}};
  const SolidAlignment alignment = align_solids(mesh, moved(motion, mesh));
  const RigidMotion error = chained(alignment.motion, inverse(motion));
  // Samples of the two are the same points but for the grid that thins them.
  EXPECT_LT(rotation_angle(error), 0.05 * kDegree);
  const ShapeDifference difference = shape_difference(moved(alignment.motion, mesh), moved(motion, mesh));
  EXPECT_LT(difference.from_moved.largest, 5e-4);
  EXPECT_NEAR(difference.mean_signed, 0, 1e-4 * bounding_diagonal(mesh.vertices));
  for (const catalog::Check& check : alignment.checks) EXPECT_TRUE(check.passed) << check.detail;
}

TEST(SolidAlignment, DistancesArePositiveOutside) {
  const catalog::TriangleMesh fixed = rock(5);
  catalog::TriangleMesh larger = fixed;
  for (Point& vertex : larger.vertices) vertex = scaled(vertex, 1.1);
  const ShapeDifference difference = shape_difference(larger, fixed);
  // The rock is star-shaped about the origin.
  EXPECT_TRUE(std::all_of(difference.distances.begin(), difference.distances.end(), [](double d) { return d > 0; }));
}

}  // namespace
}  // namespace shape_pipeline
