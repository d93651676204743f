// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/convex_decomposition.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "catalog/input_error.h"
#include "tests/support/partition_checks.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

using partition_checks::expect_matching_cuts;
using partition_checks::expect_partition;
using partition_checks::total_volume;

DecompositionOptions with(int parts, int vertex_cap = 32) {
  DecompositionOptions options;
  options.parts = parts;
  options.vertex_cap = vertex_cap;
  return options;
}

std::set<catalog::Point> corner_set(const catalog::ConvexPart& part) {
  return {part.vertices.begin(), part.vertices.end()};
}

int count_inner(const catalog::LevelOfDetail& level) {
  int count = 0;
  for (const catalog::ConvexPart& part : level.parts)
    for (const catalog::ConvexFace& face : part.faces) count += face.kind == catalog::FaceKind::inner;
  return count;
}

TEST(ConvexDecomposition, CubeIsItsOwnHullAtEveryLevel) {
  const catalog::TriangleMesh cube = solids::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (const catalog::LevelOfDetail& level : decompose_ladder(cube, {1, 2, 8})) {
    expect_partition(level);
    ASSERT_EQ(level.parts.size(), 1u);
    EXPECT_EQ(level.parts[0].face_count(), 6u);
    EXPECT_EQ(corner_set(level.parts[0]), std::set<catalog::Point>(cube.vertices.begin(), cube.vertices.end()));
    EXPECT_EQ(count_inner(level), 0);
    EXPECT_DOUBLE_EQ(level.mass_properties.volume, 1);
    EXPECT_NEAR(level.error.symmetric_difference, 0, 1e-12);
    EXPECT_NEAR(level.error.surface.largest, 0, 1e-12);
  }
}

TEST(ConvexDecomposition, FinelyMeshedCubeHasEightCorners) {
  const catalog::TriangleMesh cube = solids::voxels(
      1, [](int, int, int) { return true; }, 7);
  const catalog::LevelOfDetail level = decompose(cube, with(1));
  ASSERT_EQ(level.parts.size(), 1u);
  EXPECT_EQ(level.parts[0].vertex_count(), 8u);
  EXPECT_EQ(level.parts[0].face_count(), 6u);
}

TEST(ConvexDecomposition, TetrahedronIsItsOwnHull) {
  const catalog::LevelOfDetail level = decompose(solids::tetrahedron(), with(4, 8));
  ASSERT_EQ(level.parts.size(), 1u);
  EXPECT_EQ(level.parts[0].vertex_count(), 4u);
  EXPECT_NEAR(total_volume(level), 1.0 / 6, 1e-15);
}

TEST(ConvexDecomposition, LShapeIsTwoExactBoxesAndASplitFace) {
  const catalog::LevelOfDetail level = decompose(solids::l_shape(), with(2));
  expect_partition(level);
  expect_matching_cuts(level, 1e-12);
  ASSERT_EQ(level.parts.size(), 2u);
  EXPECT_NEAR(total_volume(level), 3, 1e-12);
  EXPECT_NEAR(level.error.symmetric_difference, 0, 1e-9);
  EXPECT_NEAR(level.error.overlap, 0, 1e-12);
  // One cut face a side; the long box's side face is split at the re-entrant edge: 6 and 7 faces.
  EXPECT_EQ(count_inner(level), 2);
  EXPECT_EQ(level.parts[0].face_count() + level.parts[1].face_count(), 13u);
  for (const auto& [plane, area] : partition_checks::inner_areas(level)) EXPECT_NEAR(area, 1, 1e-12);
}

TEST(ConvexDecomposition, CrossIsThreeExactBoxes) {
  const catalog::LevelOfDetail level = decompose(solids::flat_cross(), with(4));
  expect_partition(level);
  expect_matching_cuts(level, 1e-12);
  EXPECT_EQ(level.parts.size(), 3u);
  EXPECT_NEAR(total_volume(level), 5, 1e-12);
  EXPECT_NEAR(level.error.symmetric_difference, 0, 1e-9);
  // Mass properties of the union are the mesh's own.
  const catalog::MassProperties truth = catalog::mass_properties(solids::flat_cross());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(level.mass_properties.centroid[i], truth.centroid[i], 1e-12);
    EXPECT_NEAR(level.mass_properties.principal_inertia[i], truth.principal_inertia[i], 1e-11);
  }
}

TEST(ConvexDecomposition, SphereComesNearTheAsymptoticBound) {
  // Best polytopes of V vertices: error / volume about 0.0564 * 18.85 / V for an ellipsoid (large V).
  const catalog::TriangleMesh sphere = solids::sphere(1, 5);
  const catalog::LevelOfDetail level = decompose(sphere, with(1, 64));
  expect_partition(level);
  EXPECT_LT(level.error.symmetric_difference, 1.35 * 0.0564 * 18.85 / 64);
  EXPECT_GT(level.error.symmetric_difference, 0.0564 * 18.85 / 64);
  EXPECT_NEAR(level.error.volume_error, 0, 1e-3);
}

TEST(ConvexDecomposition, TorusGetsAHoleWithEnoughParts) {
  const catalog::TriangleMesh torus = solids::torus(1, 0.4, 24, 12);
  const std::vector<catalog::LevelOfDetail> levels = decompose_ladder(torus, {1, 8});
  for (const catalog::LevelOfDetail& level : levels) expect_partition(level);
  expect_matching_cuts(levels[1], 0.2);
  EXPECT_GT(levels[0].error.symmetric_difference, 0.4);  // one convex body must fill the hole or miss the ring
  EXPECT_LT(levels[1].error.symmetric_difference, 0.12);
  EXPECT_NEAR(levels[1].error.volume_error, 0, 2e-3);
}

TEST(ConvexDecomposition, LevelsOfTheLadderAreThoseOfSingleCalls) {
  const catalog::TriangleMesh shape = solids::l_shape();
  const std::vector<catalog::LevelOfDetail> ladder = decompose_ladder(shape, {1, 2}, with(1, 16));
  const catalog::LevelOfDetail alone = decompose(shape, with(2, 16));
  ASSERT_EQ(ladder[1].parts.size(), alone.parts.size());
  for (std::size_t p = 0; p < alone.parts.size(); ++p) EXPECT_EQ(ladder[1].parts[p].vertices, alone.parts[p].vertices);
  EXPECT_EQ(ladder[1].provenance.options, alone.provenance.options);
}

TEST(ConvexDecomposition, RefusesWhatBoundsNoSolid) {
  catalog::TriangleMesh open = solids::tetrahedron();
  open.faces.pop_back();
  EXPECT_THROW(decompose(open), catalog::InputError);
  EXPECT_THROW(decompose(catalog::TriangleMesh{}), catalog::InputError);
  catalog::TriangleMesh flat = solids::tetrahedron();
  for (catalog::Point& p : flat.vertices) p[2] = 0;
  EXPECT_THROW(decompose(flat), catalog::InputError);
  catalog::TriangleMesh inverted = solids::tetrahedron();
  for (catalog::Triangle& face : inverted.faces) std::swap(face[0], face[1]);
  EXPECT_THROW(decompose(inverted), catalog::InputError);
  catalog::TriangleMesh not_finite = solids::tetrahedron();
  not_finite.vertices[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(decompose(not_finite), catalog::InputError);
  catalog::TriangleMesh wrong_index = solids::tetrahedron();
  wrong_index.faces[0][0] = 17;
  EXPECT_THROW(decompose(wrong_index), catalog::InputError);
}

TEST(ConvexDecomposition, RefusesOptionsOutOfRange) {
  EXPECT_THROW(decompose(solids::tetrahedron(), with(0)), catalog::InputError);
  EXPECT_THROW(decompose(solids::tetrahedron(), with(2, 4)), catalog::InputError);
  EXPECT_THROW(decompose(solids::tetrahedron(), with(2, 65)), catalog::InputError);
}

}  // namespace
}  // namespace decomposition
