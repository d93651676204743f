// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/solid_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "tests/support/partition_checks.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

using solids::box;
using solids::inside_out;
using solids::moved;
using solids::together;

const catalog::TriangleMesh kCube = box({0, 0, 0}, {1, 1, 1});
const catalog::TriangleMesh kLarge = box({-5, -5, -5}, {5, 5, 5});
const catalog::TriangleMesh kHollow = box({-3, -3, -3}, {3, 3, 3});

/// The refusal of a mesh; empty if it is taken.
std::string refusal(const catalog::TriangleMesh& mesh, SeparateBodies bodies = SeparateBodies::join) {
  try {
    solid_surface(mesh, bodies);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const catalog::TriangleMesh& mesh, const std::string& cause, const std::string& remedy) {
  const std::string message = refusal(mesh);
  EXPECT_NE(message.find(cause), std::string::npos) << message;
  EXPECT_NE(message.find(remedy), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(SolidSurface, BodiesApartAreJoinedOrRefusedOrTheLargestIsTaken) {
  const catalog::TriangleMesh pair = together({kCube, moved(kLarge, {20, 0, 0})});
  const SolidSurface joined = solid_surface(pair, SeparateBodies::join);
  EXPECT_FALSE(joined.cleaned);
  EXPECT_EQ(joined.notes.bodies, 2);
  const SolidSurface largest = solid_surface(pair, SeparateBodies::largest);
  ASSERT_TRUE(largest.cleaned);
  EXPECT_NEAR(catalog::volume_moments(*largest.cleaned).volume, 1000, 1e-9);
  EXPECT_EQ(largest.cleaned->vertex_count(), 8u);
  EXPECT_EQ(largest.notes.other_bodies, 1);
  EXPECT_NEAR(largest.notes.other_volume, 1 / 1001.0, 1e-12);
  EXPECT_NE(refusal(pair, SeparateBodies::refuse).find("2 separate bodies"), std::string::npos);
  EXPECT_EQ(refusal(kCube, SeparateBodies::refuse), "");
}

TEST(SolidSurface, ACavityStaysAndAStoneInItIsABody) {
  const catalog::TriangleMesh shell = together({kLarge, inside_out(kHollow)});
  const SolidSurface hollow = solid_surface(shell, SeparateBodies::refuse);
  EXPECT_FALSE(hollow.cleaned);
  EXPECT_EQ(hollow.notes.cavities, 1);
  const catalog::TriangleMesh rattle = together({kCube, shell});
  EXPECT_EQ(solid_surface(rattle, SeparateBodies::join).notes.bodies, 2);
  const SolidSurface largest = solid_surface(rattle, SeparateBodies::largest);
  ASSERT_TRUE(largest.cleaned);
  EXPECT_NEAR(catalog::volume_moments(*largest.cleaned).volume, 1000 - 216, 1e-9) << "with its cavity";
}

TEST(SolidSurface, SurfacesInTheRockAreLeftOutAndCounted) {
  for (const catalog::TriangleMesh& inner : {kHollow, together({kHollow, inside_out(kCube)})}) {
    const catalog::TriangleMesh flawed = together({inner, kLarge});
    const SolidSurface found = solid_surface(flawed, SeparateBodies::refuse);
    ASSERT_TRUE(found.cleaned);
    EXPECT_EQ(found.notes.bodies, 1);
    // A hollow in the inner body lies in the rock of the outer one: the winding number there is 1.
    EXPECT_EQ(found.notes.inner_surfaces + found.notes.cavities, static_cast<int>(inner.face_count() / 12));
    EXPECT_GT(found.notes.inner_surfaces, 0);
  }
}

TEST(SolidSurface, BoxesThatTouchAreBodiesOfTheirOwn) {
  const catalog::TriangleMesh stack = together({kCube, moved(kCube, {0, 0, 1}), moved(kCube, {1, 0.5, 0})});
  const SolidSurface found = solid_surface(stack, SeparateBodies::join);
  EXPECT_FALSE(found.cleaned);
  EXPECT_EQ(found.notes.bodies, 3);
  EXPECT_EQ(found.notes.miscounted_volume, 0);
}

TEST(SolidSurface, WhatCountsVolumeTwiceOrInsideOutIsRefusedByName) {
  expect_refused(together({kCube, moved(kCube, {0.5, 0.2, 0.3})}), "% of its volume is enclosed more than once",
                 "talus digitize");
  expect_refused(together({kCube, kCube}), "enclosed more than once", "stand there twice");
  expect_refused(together({kLarge, moved(inside_out(kCube), {20, 0, 0})}), "1 of 2 separate surfaces are inside out",
                 "turn their faces round");
  expect_refused(inside_out(kCube), "it is inside out", "turn its faces round");
  expect_refused(inside_out(together({kLarge, inside_out(kHollow)})), "it is inside out", "turn its faces round");
  catalog::TriangleMesh doubled = kCube;
  doubled.faces.insert(doubled.faces.end(), kCube.faces.begin(), kCube.faces.end());
  expect_refused(doubled, "100 % of its volume is enclosed more than once", "talus digitize");
}

TEST(SolidSurface, SurfacesThatBarelyCutOneAnotherAreTakenAndNoted) {
  const SolidSurface found = solid_surface(together({kLarge, moved(kCube, {0, 0, 4.995})}), SeparateBodies::join);
  EXPECT_NEAR(found.notes.miscounted_volume, 0.005 / 1001, 0.05 * 0.005 / 1001) << "25 x 25 rays go through";
}

TEST(SolidSurface, BadInputNamesCauseAndRemedy) {
  expect_refused({}, "no faces", "digitise");
  expect_refused({kCube.vertices, {kCube.faces[0], kCube.faces[1], kCube.faces[2]}}, "7 open edges", "talus digitize");
  catalog::TriangleMesh open = kCube;
  open.faces.pop_back();
  expect_refused(open, "3 open edges", "talus digitize");
  expect_refused(solids::scaled(kCube, {1, 1, 1e-9}), "it is flat", "from all sides");
  expect_refused(solids::scaled(kCube, {1, 1, 0}), "it is flat", "from all sides");
  catalog::TriangleMesh not_a_number = kCube;
  not_a_number.vertices[2][1] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(not_a_number, "vertex 2 is not finite", "repair");
  expect_refused(solids::scaled(kCube, {1e30, 1e30, 1e30}), "1e+30 m from the origin", "unit");
  expect_refused(solids::scaled(kCube, {1e-30, 1e-30, 1e-30}), "1.73e-30 m across", "unit");
  catalog::TriangleMesh wrong = kCube;
  wrong.faces[3][1] = 8;
  expect_refused(wrong, "face 3 names vertex 8, expected 0 to 7", "write the mesh again");
  std::vector<catalog::TriangleMesh> scraps;
  for (int k = 0; k < 1001; ++k) scraps.push_back(moved(solids::tetrahedron(), {2.0 * k, 0, 0}));
  expect_refused(together(scraps), "1001 separate surfaces", "clean the scan");
}

TEST(SolidSurface, AllowedExtremesDecomposeAlike) {
  for (const double scale : {1e11, 1.0, 1e-11}) {
    DecompositionOptions options;
    options.parts = 2;
    const catalog::LevelOfDetail level = decompose(solids::scaled(solids::l_shape(), {scale, scale, scale}), options);
    partition_checks::expect_partition(level);
    EXPECT_EQ(level.parts.size(), 2u) << scale;
    EXPECT_NEAR(level.error.symmetric_difference, 0, 1e-9) << scale;
  }
}

TEST(SolidSurface, OptionAndNotesAreInTheProvenance) {
  DecompositionOptions options;
  options.parts = 1;
  options.bodies = SeparateBodies::largest;
  options.effort = 0.1;
  const catalog::LevelOfDetail level = decompose(together({kCube, moved(kLarge, {20, 0, 0})}), options);
  EXPECT_NEAR(level.mass_properties.volume, 1000, 1e-6);
  EXPECT_NE(level.provenance.options.find("\"bodies\":\"largest\""), std::string::npos);
  EXPECT_NE(level.provenance.options.find("\"bodies_left_out\":1"), std::string::npos);
}

}  // namespace
}  // namespace decomposition
