// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/built_in_solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/described_shape.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/solid_checks.h"

namespace shape_pipeline {
namespace {

TEST(BuiltInSolids, AreRightSolidsOfTheVolumeOfTheirFormula) {
  for (const SolidKind& kind : built_in_solids()) {
    SolidRecipe recipe{kind.name, {}, 1};
    for (const SolidParameter& parameter : kind.parameters)
      if (parameter.name == "detail") recipe.parameters["detail"] = 8;
    const BuiltSolid solid = built_in_solid(recipe);
    const catalog::ShapeRecord shape = described_shape(solid.mesh, solid.genus);
    EXPECT_TRUE(all_passed(shape.checks)) << kind.name << ": " << failures(shape.checks);
    if (solid.exact_volume) {
      EXPECT_NEAR(shape.mass_properties.volume / *solid.exact_volume, 1, solid.volume_tolerance) << kind.name;
    }
  }
}

TEST(BuiltInSolids, ThePlatonicOnesHaveTheirSpheresAndWidths) {
  struct Known {
    const char* name;
    double inscribed_over_edge, enclosing_over_edge, edge;  // edge as made
  };
  const double root5 = std::sqrt(5.0);
  const Known list[] = {
      {"tetrahedron", 1 / std::sqrt(24.0), std::sqrt(6.0) / 4, std::sqrt(8.0)},
      {"cube", 0.5, std::sqrt(3.0) / 2, 2},
      {"octahedron", 1 / std::sqrt(6.0), 1 / std::sqrt(2.0), std::sqrt(2.0)},
      {"dodecahedron", std::sqrt((25 + 11 * root5) / 40), std::sqrt(3.0) * (1 + root5) / 4, root5 - 1},
      {"icosahedron", std::sqrt(3.0) * (3 + root5) / 12, std::sqrt(10 + 2 * root5) / 4, 2}};
  for (const Known& known : list) {
    auto d = described_shape(built_in_solid({known.name, {}, 1}).mesh, 0).descriptors;
    EXPECT_NEAR(d["radius_inscribed"], known.inscribed_over_edge * known.edge, 1e-9) << known.name;
    EXPECT_NEAR(d["radius_enclosing"], known.enclosing_over_edge * known.edge, 1e-9) << known.name;
    EXPECT_NEAR(d["compactness_bagi_orosz"], 1, 1e-9) << known.name;
    EXPECT_NEAR(d["axis_short_inertia"], d["axis_long_inertia"], 1e-9) << known.name;
  }
}

TEST(BuiltInSolids, EllipsoidsConvergeWithTheSquareOfTheEdge) {
  double last = 0;
  for (const double detail : {8., 16.}) {
    const BuiltSolid solid =
        built_in_solid({"superquadric", {{"e1", 1}, {"e2", 1}, {"a", 3}, {"b", 2}, {"c", 1}, {"detail", detail}}, 1});
    auto d = described_shape(solid.mesh, 0).descriptors;
    const double error = 6 - d["axis_long_inertia"];
    EXPECT_NEAR(d["axis_short_inertia"], 2, 0.02);
    EXPECT_NEAR(d["radius_inscribed"], 1, 0.02);
    EXPECT_NEAR(d["radius_enclosing"], 3, 1e-12);  // the poles are vertices
    if (last != 0) {
      EXPECT_NEAR(last / error, 4, 0.3);
    }
    last = error;
  }
}

TEST(BuiltInSolids, AnEllipsoidAndATorusMeetTheirFormulas) {
  const double pi = std::acos(-1.0);
  const BuiltSolid ball = built_in_solid({"superquadric", {{"e1", 1}, {"e2", 1}, {"c", 2}}, 1});
  EXPECT_NEAR(*ball.exact_volume, 8 * pi / 3, 1e-12);
  // 2 and 2: an octahedron; 4/3.
  EXPECT_NEAR(*built_in_solid({"superquadric", {{"e1", 2}, {"e2", 2}}, 1}).exact_volume, 4.0 / 3, 1e-12);
  const BuiltSolid ring = built_in_solid({"ring", {{"tube", 0.5}}, 1});
  EXPECT_NEAR(*ring.exact_volume, pi * 0.25 * 2 * pi, 1e-12);
  EXPECT_EQ(mesh_topology(ring.mesh).euler_number, 0);
}

TEST(BuiltInSolids, CrushedRocksFollowTheirSeed) {
  const auto rock = [](std::uint64_t seed) { return built_in_solid({"crushed-rock", {{"facets", 20}}, seed}).mesh; };
  EXPECT_EQ(rock(3).vertices, rock(3).vertices);
  EXPECT_NE(rock(3).vertices, rock(4).vertices);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MeshTopology topology = mesh_topology(rock(seed));
    EXPECT_TRUE(topology.is_closed() && topology.euler_number == 2) << seed;
    EXPECT_GT(signed_volume(rock(seed)), 0.5) << seed;
  }
}

TEST(BuiltInSolids, AreScaledToTheSizeAsked) {
  const catalog::TriangleMesh cross = built_in_solid({"cross", {}, 1}).mesh;
  auto d = described_shape(scaled_to_size(cross, 0.012, SizeDefinition::volume), 0).descriptors;
  EXPECT_NEAR(d["equivalent_diameter_volume"], 0.012, 1e-15);
  d = described_shape(scaled_to_size(cross, 0.012, SizeDefinition::feret), 0).descriptors;
  EXPECT_NEAR(d["feret_max"], 0.012, 1e-15);
  d = described_shape(scaled_to_size(cross, 0.012, SizeDefinition::sieve), 0).descriptors;
  EXPECT_NEAR(d["sieve_size_second_axis"], 0.012, 1e-9);
}

std::string refusal(const SolidRecipe& recipe) {
  try {
    built_in_solid(recipe);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BuiltInSolids, RefuseByName) {
  EXPECT_NE(refusal({"cubee", {}, 1}).find("did you mean 'cube'"), std::string::npos);
  EXPECT_NE(refusal({"dice", {{"roundin", 0.2}}, 1}).find("did you mean 'rounding'"), std::string::npos);
  EXPECT_NE(refusal({"dice", {{"rounding", 2}}, 1}).find("expected 0.01 to 1, found 2"), std::string::npos);
  EXPECT_NE(refusal({"cube", {{"rounding", 0.2}}, 1}).find("this solid has none"), std::string::npos);
}

}  // namespace
}  // namespace shape_pipeline
