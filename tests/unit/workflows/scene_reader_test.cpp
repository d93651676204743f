// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file but its walls.
#include "workflows/scene_reader.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "dem_gpu/simulation.h"
#include "tests/unit/workflows/read_scene.h"
#include "workflows/resolved_scene.h"
#include "workflows/run_promises.h"
#include "workflows/scene_assembly.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::with;

constexpr double kPi = std::numbers::pi;

TEST(SceneReader, ReadsEverySectionInSi) {
  const SceneDescription description = read(drum_scene());
  const dem_gpu::Scene& scene = description.scene;
  EXPECT_EQ(scene.name, "drum");
  EXPECT_EQ(scene.gravity, (dem_gpu::Vec3{0, 0, -9.81}));
  EXPECT_DOUBLE_EQ(scene.run.end_time, 0.04);
  EXPECT_DOUBLE_EQ(scene.run.snapshot_interval, 0.01);
  EXPECT_DOUBLE_EQ(scene.run.checkpoint_interval, 0.02);
  EXPECT_DOUBLE_EQ(scene.run.series_interval, 0.005);
  EXPECT_EQ(scene.run.time_step, 0);
  EXPECT_EQ(scene.run.steps_per_contact, 20);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "rock");
  EXPECT_DOUBLE_EQ(scene.materials[1].density, 7800);
  EXPECT_DOUBLE_EQ(scene.contact[0][0].friction_coefficient, 0.5);
  EXPECT_DOUBLE_EQ(scene.contact[0][1].friction_coefficient, 0.3);
  EXPECT_DOUBLE_EQ(scene.contact[1][0].friction_coefficient, 0.3);
  EXPECT_DOUBLE_EQ(scene.contact[1][0].restitution, 0.4);
  EXPECT_TRUE(std::holds_alternative<dem_gpu::DepthPotential>(scene.polyhedral_law));
  EXPECT_TRUE(std::holds_alternative<dem_gpu::LinearSpring>(scene.sphere_law));
  EXPECT_TRUE(scene.friction);
  EXPECT_TRUE(scene.energy_ledger);
  EXPECT_DOUBLE_EQ(*description.stiffness.largest_overlap, 0.03);
  EXPECT_DOUBLE_EQ(description.stiffness.at_speed, 1);
  ASSERT_EQ(scene.walls.size(), 7u);
  const auto& shell = std::get<dem_gpu::Cylinder>(scene.walls[0].geometry);
  EXPECT_DOUBLE_EQ(shell.radius, 0.1);
  EXPECT_NEAR(scene.walls[0].motion.angular_velocity.y, kPi, 1e-12);  // 30 rpm
  ASSERT_EQ(description.fills.size(), 2u);
  EXPECT_EQ(std::get<std::int64_t>(description.fills[0].amount), 12);
  EXPECT_EQ(description.fills[0].layout.seed, 3u);
  EXPECT_EQ(description.fills[1].material, 1);
  EXPECT_FALSE(description.fills[1].size);
}

/// Balls over a floor in a box that is periodic along `axes`, the lines of [periodic].
std::string periodic_scene(const std::string& axes) {
  return R"(
[run]
end_time = 1
[material.rock]
density = 2700
[contact.default]
restitution = 0.5
friction = 0.5
[contact_law]
sphere_stiffness = "1e5 N/m"
[periodic]
)" + axes +
         R"(
[[wall]]
name = "floor"
type = "plane"
point = [0, 0, "-2 mm"]
normal = [0, 0, 1]
material = "rock"
[[fill]]
sphere = {diameter = "10 mm"}
material = "rock"
count = 5
where = {box = {min = [0, "-50 mm", 0], max = ["120 mm", "50 mm", "200 mm"]}}
)";
}

TEST(SceneReader, ReadsAPeriodicBox) {
  EXPECT_FALSE(read(drum_scene()).scene.periodic);
  const SceneDescription description = read(periodic_scene("x = [\"0 mm\", \"120 mm\"]\ny = [\"-5 cm\", 0.05]"));
  const dem_gpu::PeriodicBox& box = *description.scene.periodic;
  EXPECT_EQ(box.span[0], (dem_gpu::PeriodicSpan{0, 0.12}));
  EXPECT_EQ(box.span[1], (dem_gpu::PeriodicSpan{-0.05, 0.05}));
  EXPECT_FALSE(box.span[2]);
  EXPECT_NO_THROW(dem_gpu::Simulation(assemble_scene(description).scene));
  EXPECT_EQ(resolved_scene(assemble_scene(description), description, "")["periodic"].dump(),
            R"({"x":[0.0,0.12],"y":[-0.05,0.05],"z":null})");
}

TEST(SceneReader, RefusesAPeriodicBoxThatIsNone) {
  const auto expect_refused = [](const std::string& axes, const std::string& message) {
    const std::string line = refusal(periodic_scene(axes));
    EXPECT_NE(line.find(message), std::string::npos) << line;
    EXPECT_EQ(line.rfind("scene.toml:", 0), 0u) << line;
  };
  const std::string x = "x = [\"0 mm\", \"120 mm\"]\n";
  expect_refused(x + "w = [0, 1]", "periodic: unknown key 'w'");
  expect_refused("", "state along which axes");
  expect_refused("x = [\"120 mm\", 0]", "x must ascend");
  expect_refused("x = [0.12, 0.12]", "x must ascend");
  expect_refused("x = [0, 1, 2]", "x must be a pair");
  expect_refused("x = [0, \"1 kg\"]", "x[1]");
  expect_refused(x + "y = [\"-50 mm\", \"40 mm\"]", "the region spans -0.050000 .. 0.050000 m along y");
  expect_refused(x + "z = [\"0 mm\", \"150 mm\"]", "shrink the region or widen the box");
}

TEST(SceneReader, ReadsHardeningAndWhereTheOverlapIsMeant) {
  const SceneDescription description = read(
      with(drum_scene(), "at_speed = \"1 m/s\"", "at_speed = \"1 m/s\"\noverlap_at = \"corner\"\nhardening = \"2 %\""));
  const auto& law = std::get<dem_gpu::HardeningDepthPotential>(description.scene.polyhedral_law);
  EXPECT_DOUBLE_EQ(law.hardening, 0.02);
  EXPECT_DOUBLE_EQ(law.depth_cap, dem_gpu::DepthPotential{}.depth_cap);
  EXPECT_EQ(description.stiffness.overlap_at, dem_gpu::OverlapAt::corner);
}

TEST(SceneReader, ReadsPresetsLawsAndSwitches) {
  std::string text = with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"40 ms\"\npreset = \"reference\"");
  text = with(text, "polyhedra = \"depth_potential\"\nlargest_overlap = \"3 %\"\nat_speed = \"1 m/s\"",
              "polyhedra = \"volume\"\nstiffness = \"2e7 N/m3\"\nspheres = \"hertz\"\nfriction = false");
  const SceneDescription description = read(text + "[ledger]\nenabled = false\n");
  EXPECT_EQ(description.scene.run.steps_per_contact, 40);
  EXPECT_EQ(description.scene.run.preset, dem_gpu::Preset::reference);
  EXPECT_TRUE(std::holds_alternative<dem_gpu::OverlapVolume>(description.scene.polyhedral_law));
  EXPECT_TRUE(std::holds_alternative<dem_gpu::Hertz>(description.scene.sphere_law));
  EXPECT_DOUBLE_EQ(*description.stiffness.polyhedra, 2e7);
  EXPECT_FALSE(description.scene.friction);
  EXPECT_FALSE(description.scene.energy_ledger);
}

TEST(SceneReader, APresetIsAPromiseThatAStepOfOnesOwnMayBreak) {
  const auto warning_at = [](const std::string& lines) {
    const SceneDescription description =
        read(with(drum_scene(), "end_time = \"40 ms\"", "end_time = \"40 ms\"\n" + lines));
    return start_warning(assemble_scene(description).scene);
  };
  EXPECT_FALSE(warning_at(""));
  EXPECT_FALSE(warning_at("preset = \"draft\""));
  EXPECT_FALSE(warning_at("preset = \"standard\"\ntime_step = \"1 us\""));
  const dem_gpu::Scene scene = assemble_scene(read(drum_scene())).scene;
  const double shortest = dem_gpu::shortest_contact_time(scene);
  const std::string twelve_steps = "time_step = " + std::to_string(shortest / 12);
  EXPECT_FALSE(warning_at("preset = \"draft\"\n" + twelve_steps));
  const auto warning = warning_at(twelve_steps);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find(" 12 steps, not the 20 that preset \"standard\""), std::string::npos) << *warning;
}

TEST(SceneReader, CataloguePathsStartFromTheSceneFolder) {
  const SceneDescription description =
      read(with(drum_scene(), "box = {size = [\"10 mm\", \"12 mm\", \"14 mm\"]}",
                "shapes_from = \"demo.talus\"\nselect = \"sphericity_wadell > 0.7\"\nparts = 4"));
  const auto& shapes = std::get<CatalogueShapes>(description.fills[0].shapes);
  EXPECT_EQ(shapes.catalogue, "/ore/demo.talus");
  EXPECT_EQ(shapes.query, "sphericity_wadell > 0.7");
  EXPECT_EQ(shapes.parts, 4);
  EXPECT_FALSE(shapes.levels.vertex_cap);
}

TEST(SceneReader, RollingFrictionAndAdhesionOfAPair) {
  const std::string text = with(with(drum_scene(), "friction = 0.5", "friction = 0.5\nrolling_friction = \"5 %\""),
                                "friction = 0.3", "friction = 0.3\nadhesion = \"50 mJ/m2\"");
  const dem_gpu::Scene scene = read_scene_text(text, "drum.toml", ".").scene;
  EXPECT_DOUBLE_EQ(scene.contact[0][0].rolling_friction, 0.05);
  EXPECT_DOUBLE_EQ(scene.contact[0][0].adhesion, 0);
  EXPECT_DOUBLE_EQ(scene.contact[0][1].rolling_friction, 0.05) << "as [contact.default]";
  EXPECT_DOUBLE_EQ(scene.contact[0][1].adhesion, 0.05);
  EXPECT_FALSE(dem_gpu::has_adhesion(read_scene_text(drum_scene(), "drum.toml", ".").scene));
}

}  // namespace
}  // namespace workflows
