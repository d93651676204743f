// SPDX-License-Identifier: Apache-2.0
// What only the assembly or the engine can refuse names its place in the scene file all the same.
#include "workflows/scene_place.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/support/scene_text.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::place_of;
using test_support::with;

std::string refusal(const std::string& text) {
  try {
    const SceneDescription description = read_scene_text(text, "scene.toml", "");
    const AssembledScene assembled = assemble_scene(description);
    check_scene(assembled, description);
    start_simulation(assembled, description);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "not refused";
}

struct LateRefusal {
  const char* old_text;
  const char* new_text;
  const char* mark;     // where the message must point
  const char* message;  // what it must begin with, after the place
};

void PrintTo(const LateRefusal& refused, std::ostream* out) { *out << refused.message; }

class LatelyRefusedScene : public testing::TestWithParam<LateRefusal> {};

TEST_P(LatelyRefusedScene, NamesThePlace) {
  const auto& [old_text, new_text, mark, message] = GetParam();
  const std::string text = with(drum_scene(), old_text, new_text);
  const std::string line = refusal(text);
  EXPECT_EQ(line.rfind("scene.toml:" + place_of(text, mark) + ": " + message, 0), 0u) << line;
}

constexpr const char* kBox = "box = {size = [\"10 mm\", \"12 mm\", \"14 mm\"]}";
constexpr const char* kShell = "material = \"steel\"\nmotion = \"drum\"";
constexpr const char* kAtEnd = "[[lifters]]";

const LateRefusal kLateRefusals[] = {
    {kAtEnd,
     "[[wall]]\nname = \"bar\"\ntype = \"block\"\nsize = [1, 1e-12, 1]\ncentre = [5, 5, 5]\nmaterial = \"steel\"\n"
     "[[lifters]]",
     "[1, 1e-12, 1]", "wall \"bar\": size: no convex solid"},
    {kAtEnd,
     "[[wall]]\nname = \"bar\"\ntype = \"polyhedron\"\nvertices = [[5, 0, 0], [6, 0, 0], [5, 1, 0], [5, 0, 1e-7]]\n"
     "material = \"steel\"\n[[lifters]]",
     "[[5, 0, 0]", "wall \"bar\": vertices: no convex solid"},
    {"height = \"10 mm\"", "height = 1e-16", "1e-16", "lifters \"lifter\": height: no convex solid"},
    {kBox, "box = {size = [1e-9, 0.01, 0.01]}", "[[fill]]\nname = \"blocks\"", "fill \"blocks\": shape 'box "},
    {kBox, "ring = {diameter = \"10 mm\", wire = \"5 mm\"}", "\"5 mm\"}", "fill \"blocks\".ring: wire closes the ring"},
    {"\"15 mm\"", "1e-110", "[[fill]]\nname = \"balls\"", "fill \"balls\": shape 'sphere 1e-107 mm' has no volume"},
    {kShell, "material = \"steel\"\nmotion = {translate = [0, 0, 300]}", "[[wall]]", "wall 'shell': moves up to "},
    {kShell,
     "material = \"steel\"\nmotion = {swing = 1, axis = [0, 1, 0], centre = [0, 0, 0], frequency = \"4000 Hz\"}\n",
     "[[wall]]", "wall 'shell': swings at 4000 Hz"},
    {kAtEnd,
     "[[chain]]\nname = \"hoist\"\nring = {diameter = \"40 mm\", wire = \"6 mm\"}\nmaterial = \"steel\"\nlinks = 2\n"
     "start = [0, 0, -0.11]\n[[lifters]]",
     "[[chain]]", "chain \"hoist\": body 18 and wall 'shell' overlap at the start"},
    {"restitution = 0.4", "restitution = 0", "[contact.default]", "contact of 'rock' with 'rock': restitution of poly"},
    {"friction = 0.3", "friction = 0.3\nrestitution = 0", "[contact.\"rock-steel\"]",
     "contact of 'rock' with 'steel': restitution of poly"},
    {"\"40 ms\"", "\"40 ms\"\nsteps_per_contact = 3", "[run]", "run: steps per contact must be at least 5"},
    {kAtEnd, "[periodic]\ny = [-0.055, 0.055]\n[[lifters]]", "[[wall]]", "wall 'shell': it spans"},
};

INSTANTIATE_TEST_SUITE_P(ScenePlace, LatelyRefusedScene, testing::ValuesIn(kLateRefusals));

}  // namespace
}  // namespace workflows
