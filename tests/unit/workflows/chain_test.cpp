// SPDX-License-Identifier: Apache-2.0
#include "workflows/chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/input_error.h"
#include "tests/support/dem_runs.h"
#include "tests/support/linked_rings.h"
#include "tests/support/scene_text.h"
#include "workflows/ring_shape.h"
#include "workflows/scene_assembly.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kDiameter = 0.04, kWire = 0.006;

const dem_gpu::Shape& link() {
  static const dem_gpu::Shape shape = ring_shape("link", {kDiameter, kWire});
  return shape;
}

/// Are all neighbouring links linked once, and no others?
void expect_linked(const dem_gpu::Snapshot& snapshot, bool is_closed, const std::string& when) {
  const Vec3 normal = link_hole(link(), "test").normal;
  std::vector<std::vector<Vec3>> lines;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i)
    lines.push_back(test_support::ring_centreline(kDiameter, snapshot.position[i], snapshot.orientation[i], normal));
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool are_neighbours = i - j == 1 || (is_closed && i - j == lines.size() - 1);
      EXPECT_NEAR(std::abs(test_support::linking_number(lines[i], lines[j])), are_neighbours ? 1 : 0, 1e-6)
          << when << ": links " << j << " and " << i;
    }
}

Scene chain_scene(const ChainLayout& layout, double restitution, double friction) {
  Scene scene = test_support::empty_scene(restitution, friction);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.shapes = {link()};
  scene.bodies = chain_bodies(link(), layout, "chain");
  return scene;
}

TEST(RingShape, IsAPartitionOfTheRing) {
  // Pappus for a polygonal wire on a polygonal ring: area times the length of the polygon through the centroids.
  const double area = 8 * kWire * kWire / 8 * std::sin(2 * M_PI / 8), path = 12 * kDiameter * std::tan(M_PI / 12);
  const double expected = area * path * std::cos(M_PI / 12);
  // The cross-sections lie in the radial planes, so that the prisms are thinner by the cosine of half a segment.
  EXPECT_NEAR(link().volume / expected, 1, 0.04);
  EXPECT_LT(link().volume, M_PI * kWire * kWire / 4 * M_PI * kDiameter);
  EXPECT_EQ(std::get<dem_gpu::PolyhedralShape>(link().geometry).parts.size(), 12u);
  EXPECT_THROW(ring_shape("disc", {0.01, 0.006}), catalog::InputError);
}

TEST(ChainBodies, AreLinkedAndDoNotTouch) {
  for (const bool is_closed : {false, true}) {
    ChainLayout layout;
    layout.links = is_closed ? 24 : 5;
    layout.gap = is_closed ? 0.3 : 0.1;
    layout.is_closed = is_closed;
    layout.start = {0.1, 0.2, 0.3};
    layout.direction = {0.6, 0, 0.8};
    Scene scene = chain_scene(layout, 0.5, 0.3);
    Simulation simulation(scene);
    EXPECT_TRUE(simulation.snapshot().contacts.empty());
    EXPECT_LT(norm(simulation.snapshot().position[0] - layout.start), 1e-12);
    expect_linked(simulation.snapshot(), is_closed, is_closed ? "closed" : "open");
  }
}

TEST(ChainBodies, RefuseWhatCannotBeLinked) {
  const auto refusal = [](const dem_gpu::Shape& shape, const ChainLayout& layout) -> std::string {
    try {
      chain_bodies(shape, layout, "scene.toml:3:1: chain \"hoist\"");
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  ChainLayout layout;
  EXPECT_NE(refusal(test_support::box_shape({1, 1, 1}), layout).find("has no hole"), std::string::npos);
  const std::string thick = refusal(ring_shape("thick", {0.02, 0.008}), layout);
  EXPECT_NE(thick.find("thinner wire"), std::string::npos) << thick;
  layout.is_closed = true;
  layout.links = 5;
  EXPECT_NE(refusal(link(), layout).find("even number"), std::string::npos);
  layout.links = 4;
  EXPECT_NE(refusal(link(), layout).find("more links on the circle"), std::string::npos) << refusal(link(), layout);
}

TEST(Chain, HangsAndSwingsWithoutLosingALink) {
  ChainLayout layout;
  layout.links = 4;
  layout.holds_first = true;
  Scene scene = chain_scene(layout, 0.5, 0.2);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].velocity = {0.3 * double(i), 0, 0};
  Simulation simulation(scene);
  for (int i = 1; i <= 3; ++i) {
    test_support::run_to(simulation, 0.1 * i);
    expect_linked(simulation.snapshot(), false, "swinging");
  }
  EXPECT_EQ(simulation.snapshot().position[0], scene.bodies[0].position);
  const auto ledger = simulation.ledger();
  std::printf("  swinging chain of 4: energy off by %.1e, largest overlap %.3f of the diameter\n",
              ledger.imbalance() / ledger.throughput, simulation.quality().largest_overlap);
  EXPECT_LT(std::abs(ledger.imbalance()), 0.01 * ledger.throughput);
}

TEST(Chain, PulledApartHoldsAndThrownStaysLinked) {
  ChainLayout layout;
  layout.links = 3;
  Scene scene = chain_scene(layout, 0.3, 0);
  scene.gravity = {};
  // Ends fly apart at 4 m/s; without anything else the middle must hold them by geometry alone.
  scene.bodies.front().velocity = {0, 0.5, 2};
  scene.bodies.back().velocity = {0.5, 0, -2};
  Simulation simulation(scene);
  test_support::run_to(simulation, 0.1);
  expect_linked(simulation.snapshot(), false, "pulled");
  Vec3 momentum;
  for (const Vec3& velocity : simulation.snapshot().velocity) momentum += velocity;
  EXPECT_LT(norm(momentum - Vec3{0.5, 0.5, 0}), 1e-9) << "equal masses";
}

constexpr char kChainScene[] = R"(
[run]
end_time = "10 ms"
[material.steel]
density = "7800 kg/m3"
[contact.default]
restitution = 0.4
friction = 0.3
[contact_law]
largest_overlap = "2 %"
at_speed = "1 m/s"
[[chain]]
name = "hoist"
ring = {diameter = "40 mm", wire = "6 mm"}
material = "steel"
links = 6
start = [0, 0, "1 m"]
hold_first = true
)";

TEST(RingShape, TwoInOnePlaceAreRefused) {
  // All surfaces lie in one another, so that the depth is rounding or next to nothing.
  for (const double shift : {0.0, 1e-4}) {
    Scene scene = test_support::empty_scene(0.5, 0.5);
    scene.shapes = {link()};
    scene.bodies = {test_support::body_at(0, {}), test_support::body_at(0, {shift, 0, 0})};
    try {
      Simulation simulation(scene);
      ADD_FAILURE() << "accepted at " << shift;
    } catch (const catalog::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("one about the other's middle"), std::string::npos) << error.what();
    }
  }
}

TEST(ChainScene, IsReadAndAssembled) {
  const AssembledScene assembled = assemble_scene(read_scene_text(kChainScene, "chain.toml", "."));
  EXPECT_EQ(assembled.scene.bodies.size(), 6u);
  EXPECT_TRUE(assembled.scene.bodies[0].is_fixed);
  EXPECT_FALSE(assembled.scene.bodies[1].is_fixed);
  EXPECT_EQ(assembled.chains[0].bodies, 6);
  EXPECT_NEAR(assembled.chains[0].mass, 6 * 7800 * link().volume, 1e-9);
  EXPECT_LT(assembled.scene.bodies[5].position.z, assembled.scene.bodies[0].position.z - 5 * 0.02);
}

TEST(ChainScene, RefusesByNameAndPlace) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      assemble_scene(read_scene_text(text, "chain.toml", "."));
    } catch (const catalog::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using test_support::with;
  const std::string scene = kChainScene;
  EXPECT_NE(refusal(with(scene, "wire = \"6 mm\"", "wire = \"30 mm\"")).find("less than half the ring's diameter"),
            std::string::npos);
  EXPECT_NE(refusal(with(scene, "wire = \"6 mm\"", "wire = \"14 mm\"")).find("chain \"hoist\""), std::string::npos);
  EXPECT_NE(refusal(with(scene, "links = 6", "lnks = 6")).find("links"), std::string::npos);
  EXPECT_NE(refusal(with(scene, "ring = {diameter = \"40 mm\", wire = \"6 mm\"}", "")).find("state the link once"),
            std::string::npos);
}

}  // namespace
}  // namespace workflows
