// SPDX-License-Identifier: Apache-2.0
#include "workflows/idle_settings.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/workflows/read_scene.h"

namespace workflows {
namespace {

using test_support::drum_scene;
using test_support::place_of;
using test_support::with;

constexpr const char* kLaw = "largest_overlap = \"3 %\"\nat_speed = \"1 m/s\"";

std::vector<std::string> lines_of(const std::string& text) {
  const SceneDescription description = read(text);
  return idle_settings(description, assemble_scene(description).scene);
}

/// Those of settings of contacts: a drum without its blocks has no use for their material either.
std::vector<std::string> contact_lines_of(const std::string& text) {
  std::vector<std::string> lines = lines_of(text);
  std::erase_if(lines, [](const std::string& line) { return line.find("is of material") != std::string::npos; });
  return lines;
}

/// The drum without its balls, or without its blocks.
std::string without(const std::string& fill, std::string text) {
  const std::size_t start = text.find("[[fill]]\nname = \"" + fill + "\""), end = text.find("[[fill]]", start + 1);
  return text.erase(start, end == std::string::npos ? end : end - start);
}

void expect_idle(const std::string& fill, const std::string& text, const std::string& key) {
  EXPECT_TRUE(lines_of(text).empty()) << key << ": felt in the whole drum";
  const std::string alone = without(fill, text);
  const std::vector<std::string> lines = contact_lines_of(alone);
  ASSERT_EQ(lines.size(), 1u) << key;
  EXPECT_NE(lines[0].find(key + " is for contacts of "), std::string::npos) << lines[0];
  EXPECT_EQ(lines[0].rfind("scene.toml:", 0), 0u) << lines[0];
}

TEST(IdleSettings, OfSpheresInASceneOfPolyhedra) {
  expect_idle("balls", with(drum_scene(), "friction = 0.5", "friction = 0.5\nadhesion = 0.1"), "adhesion");
  expect_idle("balls", with(drum_scene(), "friction = 0.3", "friction = 0.3\nrolling_friction = 0.1"),
              "rolling_friction");
  expect_idle("balls", with(drum_scene(), kLaw, std::string(kLaw) + "\nsphere_stiffness = 1e5"), "sphere_stiffness");
}

TEST(IdleSettings, OfPolyhedraInASceneOfSpheres) {
  for (const char* line : {"hardening = 0.02", "overlap_at = \"corner\"", "depth_cap = 0.1", "stiffness = 1e8"}) {
    const std::string key(line, std::string(line).find(' '));
    expect_idle("blocks", with(drum_scene(), kLaw, std::string(kLaw) + "\n" + line), key);
  }
  const std::string text = without("blocks", with(drum_scene(), kLaw, std::string(kLaw) + "\nhardening = 0.02"));
  EXPECT_EQ(contact_lines_of(text).at(0).rfind(
                "scene.toml:" + place_of(text, "[contact_law]") + ": contact_law: hardening", 0),
            0u);
}

TEST(IdleSettings, MaterialsAndMotionsThatNothingHas) {
  const std::string text =
      drum_scene() + "\n[material.rubber]\ndensity = 1200\n[motion.shake]\noscillate = [0, 0, 0.001]\nfrequency = 5\n";
  const std::vector<std::string> lines = lines_of(text);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].rfind("scene.toml:" + place_of(text, "[material.rubber]") + ": ", 0), 0u) << lines[0];
  EXPECT_NE(lines[0].find("no fill, chain or wall is of material \"rubber\""), std::string::npos);
  EXPECT_EQ(lines[1].rfind("scene.toml:" + place_of(text, "[motion.shake]") + ": ", 0), 0u) << lines[1];
  EXPECT_NE(lines[1].find("no wall has motion = \"shake\""), std::string::npos);
}

}  // namespace
}  // namespace workflows
