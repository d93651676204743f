// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_assembly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/scene_text.h"
#include "tests/support/temporary_folder.h"

namespace workflows {
namespace {

using test_support::with;

const char* const kBoxLine = "box = {size = [\"10 mm\", \"12 mm\", \"14 mm\"]}";
const char* const kSizeLine = "size = {kind = \"single\", basis = \"mass\", definition = \"sieve\", size = \"12 mm\"}";

class SceneAssembly : public testing::Test {
 protected:
  SceneAssembly() {
    catalog::ShapeCatalog catalogue(folder_ / "ore.talus", catalog::ShapeCatalog::Access::read_write);
    for (const char* name : {"flint", "gneiss", "slate"}) {
      catalog::ShapeRecord shape = test_support::sample_shape(name);  // 2 x 1.2 x 1 mm
      shape.descriptors["axis_intermediate_obb"] = 1.2e-3;
      shape.descriptors["feret_max"] = 1e-3 * std::sqrt(4 + 1.44 + 1);
      const auto id = catalogue.store_shape(shape);
      catalogue.store_levels(id, {test_support::sample_level(shape, 2)});
    }
  }

  std::string scene_from_catalogue(const std::string& lines) const {
    return with(test_support::drum_scene(), kBoxLine, "shapes_from = \"ore.talus\"\n" + lines);
  }
  AssembledScene assemble(const std::string& text) const {
    return assemble_scene(read_scene_text(text, "scene.toml", folder_.path()));
  }
  std::string refusal(const std::string& text) const {
    try {
      assemble(text);
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "not refused";
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(SceneAssembly, BodiesHaveTheSizeAskedForByEachDefinition) {
  // The 10 x 12 x 14 box: sieve size 12, largest Feret diameter its diagonal.
  const struct {
    const char* definition;
    double size_at_scale_1;
  } cases[] = {{"sieve", 12e-3},
               {"volume-equivalent", std::cbrt(6 * 10e-3 * 12e-3 * 14e-3 / M_PI)},
               {"max-feret", std::sqrt(10e-3 * 10e-3 + 12e-3 * 12e-3 + 14e-3 * 14e-3)}};
  for (const auto& one : cases) {
    const AssembledScene assembled =
        assemble(with(test_support::drum_scene(), "\"sieve\"", "\"" + std::string(one.definition) + "\""));
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(assembled.scene.bodies[static_cast<std::size_t>(i)].scale, 12e-3 / one.size_at_scale_1, 1e-12);
  }
}

TEST_F(SceneAssembly, MassAskedForIsMet) {
  const AssembledScene assembled = assemble(with(test_support::drum_scene(), "count = 12", "mass = \"0.05 kg\""));
  const double one = 2700 * 10e-3 * 12e-3 * 14e-3;
  EXPECT_EQ(assembled.fills[0].bodies, std::lround(0.05 / one));
  EXPECT_NEAR(assembled.fills[0].mass, 0.05, one / 2);
}

TEST_F(SceneAssembly, EveryShapeIsUsedEquallyAndSizesFollowTheTable) {
  const AssembledScene assembled = assemble(with(scene_from_catalogue("parts = 2"), kSizeLine,
                                                 "size = {kind = \"table\", basis = \"mass\", definition = \"sieve\", "
                                                 "passing = [[\"8 mm\", 0], [\"10 mm\", 50], [\"12 mm\", 100]]}"));
  std::map<int, int> uses;
  for (int i = 0; i < 12; ++i) ++uses[assembled.scene.bodies[static_cast<std::size_t>(i)].shape];
  EXPECT_EQ(uses.size(), 3u);
  for (const auto& [shape, count] : uses) EXPECT_EQ(count, 4);
  EXPECT_NEAR(passing(assembled.fills[0].realised, 10e-3, SizeBasis::mass), 0.5, 0.15);  // one of twelve grains
  EXPECT_EQ(assembled.shapes[0].parts, 2);
  EXPECT_EQ(assemble(scene_from_catalogue("tolerance = \"20 %\"")).shapes[0].parts, 2) << "off by 14.3 %";
  EXPECT_EQ(assembled.catalogues.size(), 1u);
  EXPECT_EQ(assembled.catalogues[0].sha256, catalog::sha256_of_file(folder_ / "ore.talus"));
}

TEST_F(SceneAssembly, StiffnessKeepsTheHeaviestBodyWithinTheOverlap) {
  const AssembledScene assembled = assemble(test_support::drum_scene());
  const double ball = 7800 * M_PI / 6 * std::pow(15e-3, 3), depth = 0.03 * 15e-3;
  EXPECT_NEAR(std::get<dem_gpu::LinearSpring>(assembled.scene.sphere_law).stiffness, ball / (depth * depth),
              1e-6 * ball / (depth * depth));
  const double depth_potential = std::get<dem_gpu::DepthPotential>(assembled.scene.polyhedral_law).stiffness;
  EXPECT_GT(depth_potential, 0);
  // The same flat contact: k A d of the volume law for 2 k A d of the depth potential.
  const AssembledScene volume = assemble(with(test_support::drum_scene(), "\"depth_potential\"", "\"volume\""));
  EXPECT_DOUBLE_EQ(std::get<dem_gpu::OverlapVolume>(volume.scene.polyhedral_law).stiffness, 2 * depth_potential);
}

TEST_F(SceneAssembly, TheSameDescriptionGivesTheSameScene) {
  const AssembledScene a = assemble(scene_from_catalogue("parts = 2")), b = assemble(scene_from_catalogue("parts = 2"));
  ASSERT_EQ(a.scene.bodies.size(), b.scene.bodies.size());
  for (std::size_t i = 0; i < a.scene.bodies.size(); ++i) {
    EXPECT_EQ(a.scene.bodies[i].position, b.scene.bodies[i].position);
    EXPECT_EQ(a.scene.bodies[i].orientation, b.scene.bodies[i].orientation);
    EXPECT_EQ(a.scene.bodies[i].shape, b.scene.bodies[i].shape);
    EXPECT_EQ(a.scene.bodies[i].scale, b.scene.bodies[i].scale);
  }
}

TEST_F(SceneAssembly, RefusesWithPlaceAndRemedy) {
  const auto expect_refusal = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  const std::string fill =
      "scene.toml:" + test_support::place_of(test_support::drum_scene(), "[[fill]]\nname = \"blocks\"") +
      ": fill \"blocks\": ";
  expect_refusal(scene_from_catalogue("parts = 2\nselect = \"volume > 1\""),
                 fill + "select = \"volume > 1\" finds no shape");
  expect_refusal(scene_from_catalogue("parts = 2\nselect = \"volum > 1\""), "volume");
  expect_refusal(
      scene_from_catalogue("parts = 8"),
      fill +
          "shape 'flint' has no level of 8 parts (it has 2 parts of at most 64 vertices); take one of these, "
          "or make it with: talus decompose");
  expect_refusal(scene_from_catalogue("parts = 2\nvertices = 16"), "at most 64 vertices, not 16");
  expect_refusal(scene_from_catalogue("parts = 2\ntolerance = \"2 %\""), "tolerance stands beside parts");
  expect_refusal(scene_from_catalogue("tolerance = \"101 %\""), "at most 100 %");
  expect_refusal(scene_from_catalogue("tolerance = \"10 %\""),
                 fill +
                     "shape 'flint' has no level within tolerance = 10 % (its best, 2 parts of at most 64 vertices, "
                     "is off by 14.29 %); allow more, or make finer ones with: talus decompose");
  expect_refusal(
      scene_from_catalogue("tolerance = \"20 %\"\nvertices = 16"),
      "no level of at most 16 vertices within tolerance = 20 % (it has 2 parts of at most 64 vertices); take "
      "one of these, or make some with: talus decompose");
  expect_refusal(scene_from_catalogue("parts = 2\nmode = \"enclosing\"\nfaces = 34"),
                 "no level of 2 parts of at most 34 faces, enclosing (it has 2 parts of at most 64 vertices); take one "
                 "of these, or "
                 "make it with: talus decompose");
  expect_refusal(scene_from_catalogue("parts = 2\nmode = \"enclosing\"\nfaces = 34"),
                 "--parts 2 --faces 34 --mode enclosing");
  expect_refusal(scene_from_catalogue("parts = 2\nmode = \"enclosed\""), "nearest known: \"enclosing\"");
  expect_refusal(scene_from_catalogue("parts = 2\nfaces = 125"), "faces");
  expect_refusal(with(scene_from_catalogue("parts = 2"), "ore.talus", "none.talus"), "none.talus");
  expect_refusal(with(test_support::drum_scene(), "count = 12", "count = 4000"), fill + "the region holds ");
  expect_refusal(with(test_support::drum_scene(), "radius = \"10 cm\"", "radius = \"5 cm\""), "into wall \"shell\"");
  expect_refusal(with(test_support::drum_scene(), "radius = \"85 mm\"", "radius = \"84 mm\""),
                 "bodies of fill \"blocks\" and fill \"balls\" would start inside one another");
}

TEST_F(SceneAssembly, ModeAndFaceCapChooseTheLevel) {
  {
    catalog::ShapeCatalog catalogue(folder_ / "ore.talus", catalog::ShapeCatalog::Access::read_write);
    const catalog::ShapeId id = *catalogue.find("flint");
    catalog::LevelOfDetail level = test_support::sample_level(catalogue.shape(id), 2);  // usual one: off by 1/7
    level.key.face_cap = 34;
    level.error.symmetric_difference = 0.13;
    catalog::LevelOfDetail enclosing = test_support::sample_level(catalogue.shape(id), 2);
    enclosing.key.mode = catalog::FitMode::enclosing;
    enclosing.error.symmetric_difference = 0.12;
    catalogue.store_levels(id, {level, enclosing});
  }
  const auto error_of = [&](const std::string& lines) {
    return assemble(scene_from_catalogue("select = \"name = 'flint'\"\n" + lines)).shapes[0].symmetric_difference;
  };
  EXPECT_EQ(error_of("parts = 2"), 1.0 / 7) << "volume-true without a cap of faces";
  EXPECT_EQ(error_of("parts = 2\nfaces = 34"), 0.13);
  EXPECT_EQ(error_of("parts = 2\nmode = \"enclosing\""), 0.12);
  EXPECT_EQ(error_of("tolerance = \"13.5 %\""), 0.13) << "any cap of faces";
  EXPECT_EQ(error_of("tolerance = \"15 %\"\nfaces = 0"), 1.0 / 7) << "none";
  EXPECT_EQ(error_of("tolerance = \"15 %\"\nmode = \"enclosing\""), 0.12);
}

TEST_F(SceneAssembly, RefusalsNameTheLevelsOfOtherKindsAndNoLevelBeyondTheMost) {
  const auto refusal_with = [&](catalog::LevelKey key, const std::string& lines) {
    const std::string file = "levels_" + std::to_string(key.parts_asked) + ".talus";
    {
      catalog::ShapeCatalog catalogue(folder_ / file, catalog::ShapeCatalog::Access::read_write);
      const catalog::ShapeRecord shape = test_support::sample_shape("flint");
      catalog::LevelOfDetail level = test_support::sample_level(shape, 2);
      level.key = key;
      level.error.symmetric_difference = 0.05;
      catalogue.store_levels(catalogue.store_shape(shape), {level});
    }
    return refusal(with(scene_from_catalogue(lines), "ore.talus", file));
  };
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(refusal_with({3, 32, 24}, "parts = 3"),
         "(it has 3 parts of at most 32 vertices and 24 faces); take one of these, or make it with");
  expect(refusal_with({200, 32}, "tolerance = \"2 %\""),
         "make finer ones with: talus decompose " + (folder_ / "levels_200.talus").string() + " --parts 256");
  const std::string none_finer = refusal_with({256, 32}, "tolerance = \"2 %\"");
  expect(none_finer, "is off by 5 %); allow more: no level has more than 256 parts");
  EXPECT_EQ(none_finer.find("--parts"), std::string::npos) << none_finer;
}

TEST_F(SceneAssembly, BodiesWeighWhatTheirLevelWeighs) {
  constexpr double kWider = 1.1;  // of the enclosing level, along every axis
  {
    catalog::ShapeCatalog catalogue(folder_ / "ore.talus", catalog::ShapeCatalog::Access::read_write);
    const catalog::ShapeId id = *catalogue.find("flint");
    catalog::LevelOfDetail enclosing = test_support::sample_level(catalogue.shape(id), 2);
    enclosing.key.mode = catalog::FitMode::enclosing;
    for (catalog::ConvexPart& part : enclosing.parts) {
      for (catalog::Point& vertex : part.vertices)
        for (double& x : vertex) x *= kWider;
      for (catalog::ConvexFace& face : part.faces) face.plane.offset *= kWider;
    }
    catalogue.store_levels(id, {enclosing});
  }
  const auto one_body = [&](const std::string& lines) {
    const AssembledScene assembled = assemble(scene_from_catalogue("select = \"name = 'flint'\"\nparts = 2\n" + lines));
    return assembled.fills[0].mass / static_cast<double>(assembled.fills[0].bodies);
  };
  // Sizes are those of the mesh, so the scale is the same; rounding of a few sums of products.
  EXPECT_NEAR(one_body("mode = \"enclosing\"") / one_body(""), std::pow(kWider, 3), 1e-9);
}

TEST_F(SceneAssembly, AMissingDescriptorIsNamedOnlyWhereItIsNeeded) {
  {
    catalog::ShapeCatalog catalogue(folder_ / "bare.talus", catalog::ShapeCatalog::Access::read_write);
    const catalog::ShapeRecord shape = test_support::sample_shape("bare");
    catalogue.store_levels(catalogue.store_shape(shape), {test_support::sample_level(shape, 2)});
  }
  const std::string text = with(scene_from_catalogue("parts = 2"), "ore.talus", "bare.talus");
  EXPECT_NE(refusal(text).find("shape 'bare' has no descriptor for its sieve size"), std::string::npos)
      << refusal(text);
  EXPECT_NO_THROW(assemble(with(text, "\"sieve\"", "\"volume-equivalent\"")));
}

}  // namespace
}  // namespace workflows
