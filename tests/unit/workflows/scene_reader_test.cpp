// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "tests/support/scene_text.h"
#include "tests/support/temporary_folder.h"
#include "workflows/run_promises.h"
#include "workflows/scene_assembly.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::place_of;
using test_support::with;

constexpr double kPi = std::numbers::pi;

SceneDescription read(const std::string& text) { return read_scene_text(text, "scene.toml", "/ore"); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "not refused";
}

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

TEST(SceneReader, LiftersRiseFromTheShellAndTurnWithIt) {
  const dem_gpu::Scene scene =
      read(with(drum_scene(), "height = \"10 mm\"", "height = \"10 mm\"\nface_angle = \"70 deg\"")).scene;
  for (int i = 0; i < 6; ++i) {
    const dem_gpu::Wall& lifter = scene.walls[static_cast<std::size_t>(1 + i)];
    EXPECT_EQ(lifter.name, "lifter_0" + std::to_string(i));
    EXPECT_EQ(lifter.contact_class, "lifter");
    EXPECT_EQ(lifter.material, 1);
    EXPECT_EQ(lifter.motion.angular_velocity, scene.walls[0].motion.angular_velocity);
    const auto& part = std::get<dem_gpu::VolumeObject>(lifter.geometry).part;
    ASSERT_EQ(part.vertex_count(), 8u);
    int behind_shell = 0, at_top = 0;
    double top_width = 0;
    for (const catalog::Point& p : part.vertices) {
      // The shell's axis is y; the lifter's direction is read off its own centre.
      const catalog::Point centre = mass_properties(volume_moments(triangulated(part))).centroid;
      const double length = std::hypot(centre[0], centre[2]);
      const double out = (p[0] * centre[0] + p[2] * centre[2]) / length;
      const double side = (p[0] * centre[2] - p[2] * centre[0]) / length;
      if (std::hypot(p[0], p[2]) > 0.1) ++behind_shell;
      if (std::abs(out - 0.09) < 1e-12) ++at_top, top_width = std::max(top_width, 2 * std::abs(side));
      EXPECT_GE(std::abs(p[1]), 0.05);  // past both ends of the shell
    }
    EXPECT_EQ(behind_shell, 4);
    EXPECT_EQ(at_top, 4);
    EXPECT_NEAR(top_width, 0.02 - 2 * 0.01 / std::tan(70 * kPi / 180), 1e-12);
  }
}

/// A tetrahedron as text, in millimetres; `normals_out` or turned round.
std::string tetrahedron_stl(bool normals_out) {
  const std::string corner[] = {"vertex 0 0 0\n", "vertex 10 0 0\n", "vertex 0 10 0\n", "vertex 0 0 10\n"};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = "solid t\n";
  for (const auto& f : faces)
    text += "facet normal 0 0 0\nouter loop\n" + corner[f[0]] + corner[f[normals_out ? 1 : 2]] +
            corner[f[normals_out ? 2 : 1]] + "endloop\nendfacet\n";
  return text + "endsolid t\n";
}

TEST(SceneReader, MeshWallsComeFromStlFiles) {
  const test_support::TemporaryFolder folder;
  const auto scene_with = [&](const std::string& stl, const std::string& more) {
    test_support::write_bytes(folder / "t.stl", stl);
    const std::string text = drum_scene() +
                             "\n[[wall]]\nname = \"t\"\ntype = \"mesh\"\nfile = \"t.stl\"\nunit = \"mm\"\nmaterial = "
                             "\"steel\"\n" +
                             more;
    return read_scene_text(text, "scene.toml", folder.path()).scene;
  };
  const auto refusal_with = [&](const std::string& stl, const std::string& more) -> std::string {
    try {
      scene_with(stl, more);
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  const dem_gpu::Scene scene =
      scene_with(tetrahedron_stl(true), "motion = {oscillate = [0, 0, \"1 mm\"], frequency = \"20 Hz\"}\n");
  const auto wall =
      std::find_if(scene.walls.begin(), scene.walls.end(), [](const dem_gpu::Wall& one) { return one.name == "t"; });
  ASSERT_NE(wall, scene.walls.end());
  const auto& mesh = std::get<dem_gpu::MeshObject>(wall->geometry).mesh;
  EXPECT_EQ(mesh.vertices.size(), 4u) << "corners at one place are one vertex";
  EXPECT_DOUBLE_EQ(mesh.vertices[1][1], 0.01);
  EXPECT_DOUBLE_EQ(wall->motion.amplitude.z, 1e-3);
  EXPECT_NEAR(wall->motion.frequency, 20, 1e-12);
  EXPECT_NE(refusal_with(tetrahedron_stl(false), "").find("inverted"), std::string::npos);
  EXPECT_EQ(refusal_with(tetrahedron_stl(false), "bodies = \"inside\"\n"), "not refused");
  EXPECT_NE(refusal_with("solid t\nfacet normal 0 0 1\n", "").find("ends before endsolid"), std::string::npos);
  EXPECT_NE(refusal_with("junk", "").find("expected an STL file"), std::string::npos);
}

TEST(SceneReader, LiftersStandEvenlyAroundTheAxis) {
  const dem_gpu::Scene scene = read(drum_scene()).scene;
  const auto centre = [&](std::size_t lifter) {
    return mass_properties(
               volume_moments(triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[1 + lifter].geometry).part)))
        .centroid;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const catalog::Point a = centre(i), b = centre((i + 1) % 6);
    const double cosine = (a[0] * b[0] + a[2] * b[2]) / (std::hypot(a[0], a[2]) * std::hypot(b[0], b[2]));
    EXPECT_NEAR(cosine, std::cos(2 * kPi / 6), 1e-12);
  }
}

TEST(SceneReader, ReadsEveryWallTypeGatesAndOutflow) {
  const std::string walls = R"(
[[wall]]
name = "floor"
type = "plane"
point = [0, 0, -1]
normal = [0, 0, 2]
material = "steel"
[[wall]]
name = "gate"
type = "disc"
centre = [0, 0, 0]
normal = [0, 0, 1]
radius = "8 cm"
material = "steel"
open_at = "1.2 s"
motion = {translate = [0, 0, "-10 mm/s"], start = "1 s", ramp = "0.1 s"}
[[wall]]
name = "cone"
type = "cone"
base = [0, 0, 0]
axis = [0, 0, 1]
length = 0.3
base_radius = 0.08
top_radius = 0.2
material = "steel"
class = "shell"
[[wall]]
name = "bar"
type = "block"
size = [2, 0.2, 0.1]
centre = [5, 5, 5]
rotation = {axis = [0, 0, 1], angle = "90 deg"}
material = "steel"
[[wall]]
name = "wedge"
type = "polyhedron"
vertices = [[9, 0, 0], [10, 0, 0], [9, 1, 0], [9, 0, 1]]
material = "steel"
[outflow]
height = "-5 cm"
)";
  const dem_gpu::Scene scene = read(drum_scene() + walls).scene;
  ASSERT_EQ(scene.walls.size(), 12u);
  EXPECT_EQ(std::get<dem_gpu::Plane>(scene.walls[1].geometry).normal, (dem_gpu::Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(*scene.walls[2].removed_at, 1.2);
  EXPECT_DOUBLE_EQ(scene.walls[2].motion.velocity.z, -0.01);
  EXPECT_DOUBLE_EQ(scene.walls[2].motion.ramp_time, 0.1);
  EXPECT_DOUBLE_EQ(std::get<dem_gpu::Cone>(scene.walls[3].geometry).top_radius, 0.2);
  EXPECT_EQ(scene.walls[3].contact_class, "shell");
  const auto bar = triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[4].geometry).part);
  EXPECT_NEAR(volume_moments(bar).volume, 2 * 0.2 * 0.1, 1e-12);
  for (const catalog::Point& p : bar.vertices) {
    EXPECT_NEAR(std::abs(p[0] - 5), 0.1, 1e-12);
    EXPECT_NEAR(std::abs(p[1] - 5), 1, 1e-12);
  }
  EXPECT_NEAR(volume_moments(triangulated(std::get<dem_gpu::VolumeObject>(scene.walls[5].geometry).part)).volume,
              1.0 / 6, 1e-12);
  EXPECT_DOUBLE_EQ(scene.outflow->height, -0.05);
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
  EXPECT_FALSE(shapes.vertex_cap);
}

struct BadScene {
  const char* old_text;
  const char* new_text;  // what is wrong
  const char* mark;      // in the new text: where the message must point
  const char* message;   // part of it
};

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.message; }

class RefusedScene : public testing::TestWithParam<BadScene> {};

TEST_P(RefusedScene, NamesPlaceAndRemedy) {
  const auto& [old_text, new_text, mark, message] = GetParam();
  const std::string text = with(drum_scene(), old_text, new_text);
  const std::string line = refusal(text);
  EXPECT_EQ(line.rfind("scene.toml:" + place_of(text, mark) + ": ", 0), 0u) << line;
  EXPECT_NE(line.find(message), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

const BadScene kBadScenes[] = {
    // unknown keys
    {"snapshot_every", "snapshots_every", "snapshots_every",
     "run: unknown key 'snapshots_every'; nearest known key: 'snapshot_every'"},
    {"radius = \"10 cm\"", "raduis = \"10 cm\"", "raduis",
     "wall \"shell\": unknown key 'raduis'; nearest known key: 'radius'"},
    {"[motion.drum]", "[motoin.drum]", "motoin", "unknown key 'motoin'; nearest known key: 'motion'"},
    {"seed = 3", "seeds = 3", "seeds", "unknown key 'seeds'; nearest known key: 'seed'"},
    {"\"sieve\", size", "\"sieve\", sizes", "sizes =", "unknown key 'sizes'; nearest known key: 'size'"},
    {"gravity =", "gravty =", "gravty", "nearest known key: 'gravity'"},
    // unknown words
    {"type = \"cylinder\"", "type = \"cylindre\"", "\"cylindre\"", "nearest known: \"cylinder\""},
    {"material = \"rock\"", "material = \"rok\"", "\"rok\"", "nearest known: \"rock\""},
    {"motion = \"drum\"", "motion = \"dram\"", "\"dram\"", "nearest known: \"drum\""},
    {"on = \"shell\"", "on = \"shel\"", "\"shel\"", "nearest known: \"shell\""},
    {"[contact.\"rock-steel\"]", "[contact.\"rock-stel\"]", "[contact.\"rock-stel\"]", "nearest known: \"rock-steel\""},
    {"basis = \"mass\"", "basis = \"volume\"", "\"volume\"", "of \"mass\", \"number\""},
    // missing keys
    {"end_time = \"40 ms\"\n", "", "[run]", "key 'end_time' is missing"},
    {"basis = \"mass\", ", "", "{kind", "key 'basis' is missing"},
    {"definition = \"sieve\", ", "", "{kind", "key 'definition' is missing"},
    {"count = 12\n", "", "[[fill]]\nname = \"blocks\"", "either count or mass"},
    {"largest_overlap = \"3 %\"\nat_speed = \"1 m/s\"", "", "[contact_law]", "how stiff contacts are"},
    {"at_speed = \"1 m/s\"", "at_speed = \"1 m/s\"\nhardening = 0", "0\n\n[motion.drum]", "it must be more than 0"},
    {"at_speed = \"1 m/s\"", "at_speed = \"1 m/s\"\noverlap_at = \"edge\"", "\"edge\"", "\"face\", \"corner\""},
    {"polyhedra = \"depth_potential\"", "polyhedra = \"volume\"\nhardening = \"3 %\"", "hardening",
     "unknown key 'hardening'"},
    // wrong types
    {"end_time = \"40 ms\"", "end_time = true", "true",
     "end_time is true or false; expected a number in SI, or text ending in one of s, ms"},
    {"name = \"drum\"", "name = 7", "7", "name is a number; expected text"},
    {"count = 12", "count = 12.5", "12.5", "a whole number from 1 to"},
    {"[[lifters]]", "[lifters]", "[lifters]", "expected tables headed [[lifters]]"},
    {"centre = [0, 0, 0]", "centre = [0, 0]", "[0, 0]", "an array of three"},
    // units
    {"\"10 cm\"", "\"10 furlongs\"", "\"10 furlongs\"",
     "radius is \"10 furlongs\"; expected a number in SI, or text ending in one of m, cm, mm"},
    {"\"30 rpm\"", "\"30 mm\"", "\"30 mm\"", "rad/s, rpm"},
    {"\"2700 kg/m3\"", "\"2700 kg\"", "\"2700 kg\"", "kg/m3"},
    // values
    {"\"10 cm\"", "\"-10 cm\"", "\"-10 cm\"", "it must be more than 0"},
    {"radius = \"10 cm\"", "radius = nan", "nan", "it must be more than 0"},
    {"density = \"2700 kg/m3\"", "density = 0", "0\n\n[material.steel]", "it must be more than 0"},
    {"restitution = 0.4", "restitution = 1.4", "1.4", "from 0 to 1"},
    {"restitution = 0.4", "restitution = -0.4", "-0.4", "from 0 to 1"},
    {"friction = 0.5", "friction = -0.5", "-0.5", "0 or more"},
    {"friction = 0.5", "friction = 0.5\nrolling_friction = -0.1", "-0.1", "0 or more"},
    {"friction = 0.5", "friction = 0.5\nadhesion = \"1 J\"", "\"1 J\"", "J/m2, mJ/m2"},
    {"count = 12", "count = -12", "-12", "from 1 to"},
    {"axis = [0, 1, 0]\nradius", "axis = [0, 0, 0]\nradius", "[0, 0, 0]\nradius", "must point somewhere"},
    {"height = \"10 mm\"", "height = \"30 cm\"", "\"30 cm\"", "less than the shell's radius"},
    {"kind = \"single\", basis = \"mass\", definition = \"sieve\", size = \"12 mm\"",
     "kind = \"table\", basis = \"mass\", definition = \"sieve\", passing = [[\"2 mm\", 0], [\"4 mm\", 90]]",
     "[[\"2 mm\"", "it must end at 100"},
    {"kind = \"single\", basis = \"mass\", definition = \"sieve\", size = \"12 mm\"",
     "kind = \"table\", basis = \"mass\", definition = \"sieve\", passing = [[\"4 mm\", 0], [\"2 mm\", 100]]",
     "[[\"4 mm\"", "sizes must ascend"},
    {"kind = \"single\", basis = \"mass\", definition = \"sieve\", size = \"12 mm\"",
     "kind = \"table\", basis = \"mass\", definition = \"sieve\", passing = [[\"2 mm\", 10], [\"4 mm\", 100]]",
     "[[\"2 mm\"", "must start at 0"},
    {"kind = \"single\", basis = \"mass\", definition = \"sieve\", size = \"12 mm\"",
     "kind = \"lognormal\", basis = \"mass\", definition = \"sieve\", d50 = \"5 mm\", sigma_g = 1.3, min = 3, max = 8",
     "3, max", "check the units"},
    // contradictions
    {"count = 12\n", "count = 12\nmass = \"1 kg\"\n", "[[fill]]\nname = \"blocks\"", "either count or mass"},
    {"sphere = {diameter = \"15 mm\"}", "sphere = {diameter = \"15 mm\"}\nbox = {size = [1, 1, 1]}",
     "[[fill]]\nname = \"balls\"", "state the shape once"},
    // not TOML
    {"end_time = \"40 ms\"", "end_time = 40 ms", "ms\nsnapshot", "not TOML"},
};

INSTANTIATE_TEST_SUITE_P(SceneReader, RefusedScene, testing::ValuesIn(kBadScenes));

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

TEST(SceneReader, RefusesWallsOfOneName) {
  const std::string text = drum_scene() +
                           "[[wall]]\nname = \"shell\"\ntype = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"
                           "material = \"steel\"\n";
  EXPECT_NE(refusal(text).find("two walls are named \"shell\""), std::string::npos) << refusal(text);
  // At the second one's name: the fourth line from the end.
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_NE(refusal(text).find(":" + std::to_string(lines - 4) + ":"), std::string::npos) << refusal(text);
}

TEST(SceneReader, RefusesNamesThatCannotBeToldApart) {
  const auto expect_refused = [](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  expect_refused(with(drum_scene(), "name = \"balls\"", "name = \"blocks\""), "two fills are named \"blocks\"");
  expect_refused(with(drum_scene(), "[contact_law]", "[contact.\"steel-rock\"]\nfriction = 0.2\n[contact_law]"),
                 "stated already, in the other order");
  expect_refused(with(drum_scene(), "[[lifters]]",
                      "[[wall]]\nname = \"lifter_02\"\ntype = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"
                      "material = \"steel\"\n[[lifters]]"),
                 "two walls are named \"lifter_02\"");
  expect_refused(drum_scene() + "[motion.spin]\nrotate = \"3 rpm\"\n[motion.spin]\nrotate = \"4 rpm\"\n",
                 "motion.spin");
  for (const char* name : {".", "..", "a/b"})
    expect_refused(with(drum_scene(), "name = \"drum\"", "name = \"" + std::string(name) + "\""), "name must not");
}

TEST(SceneReader, RefusesTextWithoutItsUnit) {
  const std::string line = refusal(with(drum_scene(), "\"10 cm\"", "\"0.1\""));
  EXPECT_NE(line.find("radius is \"0.1\"; expected a number in SI, or text ending in one of m,"), std::string::npos)
      << line;
}

TEST(SceneReader, RefusesFilesThatAreNotScenes) {
  const test_support::TemporaryFolder folder;
  EXPECT_THROW(read_scene(folder / "missing.toml"), catalog::InputError);
  EXPECT_THROW(read_scene(folder.path()), catalog::InputError);
  test_support::write_bytes(folder / "empty.toml", "");
  EXPECT_THROW(read_scene(folder / "empty.toml"), catalog::InputError);
  test_support::write_bytes(folder / "binary.toml", std::string("\x00\x01\xff\xfe", 4));
  EXPECT_THROW(read_scene(folder / "binary.toml"), catalog::InputError);
}

}  // namespace
}  // namespace workflows
