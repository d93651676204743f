// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of virtual rocks, turned and shifted at random: where do they come to lie?
#include "shape_pipeline/registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/solid_alignment.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/virtual_scan.h"

namespace shape_pipeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

catalog::TriangleMesh rock(std::uint64_t seed) {
  RockRecipe recipe;
  recipe.seed = seed;
  recipe.flatness = 0.75;
  recipe.notch_depth = seed % 2 == 0 ? 0.3 : 0;
  return virtual_rock(recipe);
}

RigidMotion random_motion(RandomStream& random, double reach) {
  const Point axis = random.direction(), other = random.direction();
  const Point across = normalized(cross(axis, other));
  const Point third = cross(axis, across);
  return {{axis, across, third}, scaled(random.direction(), reach)};
}

/// Parts that each miss a third of the surface, and the motions that bring them back to the first.
struct PartialScans {
  std::vector<PartialScan> parts;
  std::vector<RigidMotion> truth;
};

PartialScans partial_scans(const catalog::TriangleMesh& mesh, int count, std::uint64_t seed) {
  RandomStream random(seed);
  PartialScans scans;
  RigidMotion first;
  for (int p = 0; p < count; ++p) {
    ScannerFlaws flaws;
    flaws.seed = random.bits();
    flaws.gap_angle = std::acos(0.3);  // a cap of 35 % of all directions
    const RigidMotion motion = random_motion(random, 0.2);
    if (p == 0) first = motion;
    scans.parts.push_back({"part" + std::to_string(p + 1) + ".ply", moved(motion, virtual_scan(mesh, flaws))});
    scans.truth.push_back(chained(first, inverse(motion)));
  }
  return scans;
}

struct PoseError {
  double degrees = 0, shift = 0;  // of the rock's centre / diagonal
};

PoseError worst_error(const RegisteredParts& found, const PartialScans& scans, double diagonal) {
  PoseError worst;
  for (std::size_t p = 1; p < scans.parts.size(); ++p) {
    const RigidMotion error = chained(found.motions[p], inverse(scans.truth[p]));
    // The rock's centre in the frame of the first part is where that part's motion took the origin.
    Point centre{};
    for (const Point& point : scans.parts[0].cloud.points)
      centre = add(centre, scaled(point, 1.0 / static_cast<double>(scans.parts[0].cloud.points.size())));
    worst.degrees = std::max(worst.degrees, rotation_angle(error) / kDegree);
    worst.shift = std::max(worst.shift, distance(moved(error, centre), centre) / diagonal);
  }
  return worst;
}

class Registrations : public testing::TestWithParam<int> {};

TEST_P(Registrations, BringThePartsOfARockTogether) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const catalog::TriangleMesh mesh = rock(seed);
  const PartialScans scans = partial_scans(mesh, 3, seed);
  const RegisteredParts found = register_parts(scans.parts);
  const PoseError error = worst_error(found, scans, bounding_diagonal(mesh.vertices));
  for (const catalog::Check& check : found.checks)
    std::cout << check.name << ' ' << check.figure << ' ' << check.detail << '\n';
  std::cout << "rotation " << error.degrees << " degrees, shift " << 100 * error.shift << " % of the diagonal\n";
  // At 0.5 degrees the seam of two parts stands off by 0.4 % of the diagonal, half a face of a mesh of 10000.
  EXPECT_LT(error.degrees, 0.5);
  EXPECT_LT(error.shift, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Rocks, Registrations, testing::Range(1, 4));

TEST(Registration, IsTheSameOnEveryCall) {
  const PartialScans scans = partial_scans(rock(2), 2, 5);
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
  const PartialScans scans = partial_scans(rock(1), 2, 1);
  EXPECT_NE(refusal({scans.parts[0]}).find("part1.ply: registration needs two"), std::string::npos);
  std::vector<PartialScan> mixed = scans.parts;
  for (Point& point : mixed[1].cloud.points) point = scaled(point, 1000);
  EXPECT_NE(refusal(mixed).find("part2.ply is 1"), std::string::npos) << refusal(mixed);
  const std::vector<PartialScan> strangers{scans.parts[0], partial_scans(rock(2), 2, 3).parts[1]};
  EXPECT_NE(refusal(strangers).find("part2.ply: does not fit the other parts"), std::string::npos)
      << refusal(strangers);
}

TEST(SolidAlignment, FindsTheMotionOfATurnedRock) {
  const catalog::TriangleMesh mesh = rock(4);
  RandomStream random(9);
  const RigidMotion motion = random_motion(random, 0.1);
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
