// SPDX-License-Identifier: Apache-2.0
// What a scene file may not say: refused in one line with its place.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/unit/workflows/read_scene.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::place_of;
using test_support::with;

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
    {"seed = 3", "colour = 3", "colour", "unknown key 'colour'; known keys: 'box', "},
    // unknown words
    {"type = \"cylinder\"", "type = \"pipe\"", "\"pipe\"", "expected one of \"plane\", \"disc\""},
    {"type = \"cylinder\"", "type = \"cylindre\"", "\"cylindre\"", "nearest known: \"cylinder\""},
    {"material = \"rock\"", "material = \"rok\"", "\"rok\"", "nearest known: \"rock\""},
    {"motion = \"drum\"", "motion = \"dram\"", "\"dram\"", "nearest known: \"drum\""},
    {"on = \"shell\"", "on = \"shel\"", "\"shel\"", "nearest known: \"shell\""},
    {"[contact.\"rock-steel\"]", "[contact.\"rock-stel\"]", "[contact.\"rock-stel\"]", "did you mean 'rock-steel'?"},
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
    // values out of reach
    {"at_speed = \"1 m/s\"", "at_speed = 1e200", "1e200",
     "contact_law: at_speed is 1e+200; it must be more than 0 (1e-9"},
    {"largest_overlap = \"3 %\"\nat_speed = \"1 m/s\"", "stiffness = 1e7\nsphere_stiffness = 1e-300", "1e-300",
     "sphere_stiffness is 1e-300"},
    {"largest_overlap = \"3 %\"\nat_speed = \"1 m/s\"", "stiffness = 1e300\nsphere_stiffness = 1e5", "1e300",
     "stiffness is 1e+300"},
    {"friction = 0.5", "friction = 1e300", "1e300", "friction is 1e+300; it must be 0 or more, at most 1e6"},
    {"friction = 0.5", "friction = 0.5\nrolling_friction = 1.5", "1.5",
     "rolling_friction is 1.5; it must be 0 or more"},
    {"friction = 0.5", "friction = 0.5\nadhesion = 1e300", "1e300", "adhesion is 1e+300"},
    {"density = \"2700 kg/m3\"", "density = 1e300", "1e300", "density is 1e+300"},
    {"\"-9.81 m/s2\"", "1e300", "1e300", "gravity[2] is 1e+300; it must be from -1e6 to 1e6 m/s2"},
    {"motion = \"drum\"", "motion = {translate = [0, 0, 1e300]}", "1e300", "translate[2] is 1e+300"},
    {"seed = 3", "seed = 3\nvelocity = [0, 1e300, 0]", "1e300", "velocity[1] is 1e+300"},
    {"\"40 ms\"", "\"40 ms\"\nsteps_per_contact = 1e6", "1e6", "steps_per_contact is 1e+06"},
    {"box = {size = [\"10 mm\", \"12 mm\", \"14 mm\"]}",
     "ring = {diameter = \"12 mm\", wire = \"2 mm\", segments = 300, sides = 32}", "300, sides",
     "segments x sides is 9600; at most 5000"},
    // names
    {"name = \"shell\"", "name = \"\"", "\"\"", "name is \"\"; a name must not be empty"},
    {"name = \"shell\"", "name = \"a,b\"", "\"a,b\"", "name is \"a,b\""},
    {"name = \"shell\"", "name = \"a\\\"b\"", "\"a\\\"b\"", "a name must not"},
    {"name = \"blocks\"", "name = \"b\\nocks\"", "\"b\\nocks\"", "name is \"b?ocks\""},
    {"motion = \"drum\"", "motion = \"drum\"\nclass = \"a/b\"", "\"a/b\"", "class is \"a/b\""},
    {"on = \"shell\"", "on = \"shell\"\nname = \"l\\u007f\"", "\"l\\u007f\"", "name is \"l?\""},
    {"[material.steel]", "[material.\"a,b\"]", "\"a,b\"", "material is named \"a,b\""},
    {"[motion.drum]", "[motion.\"\"]", "\"\"]", "motion is named \"\""},
    // contradictions
    {"count = 12\n", "count = 12\nmass = \"1 kg\"\n", "[[fill]]\nname = \"blocks\"", "either count or mass"},
    {"sphere = {diameter = \"15 mm\"}", "sphere = {diameter = \"15 mm\"}\nbox = {size = [1, 1, 1]}",
     "[[fill]]\nname = \"balls\"", "state the shape once"},
    // not TOML
    {"end_time = \"40 ms\"", "end_time = 40 ms", "ms\nsnapshot", "not TOML"},
};

INSTANTIATE_TEST_SUITE_P(SceneRefusals, RefusedScene, testing::ValuesIn(kBadScenes));

TEST(SceneRefusals, RefusesNamesThatCannotBeToldApart) {
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

TEST(SceneRefusals, RefusesTextWithoutItsUnit) {
  const std::string line = refusal(with(drum_scene(), "\"10 cm\"", "\"0.1\""));
  EXPECT_NE(line.find("radius is \"0.1\"; expected a number in SI, or text ending in one of m,"), std::string::npos)
      << line;
}

TEST(SceneRefusals, RefusesFilesThatAreNotScenes) {
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
