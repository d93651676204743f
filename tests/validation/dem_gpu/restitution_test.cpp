// SPDX-License-Identifier: Apache-2.0
// Restitution asked for is restitution got: polyhedra on faces, edges and corners, every normal law, on walls, objects
// and bodies, at the step of each preset, wherever in a step they touch.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "dem_gpu/run_promise.h"
#include "tests/support/cube_attitudes.h"
#include "tests/support/dem_runs.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using dem_gpu::Preset;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;        // of the cube [m]
constexpr Real kSpeed = 1;          // of approach [m/s]
constexpr Real kStiffness = 1e9;    // k [N/m3]: a face sinks in by 1.6 % of the edge
constexpr Real kSlabLength = 4;     // [m]
constexpr int kPhases = 12;         // of the step at first contact
constexpr Real kApart = 6 * kEdge;  // between impacts side by side [m]
constexpr double kAsked[] = {0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0};
const Vec3 kAlong = {0.7, 0.4, 0};  // tangential velocity of oblique impacts [m/s]

const std::array<Attitude, 3> kAttitudes = cube_attitudes(kEdge);

enum class Ground { plane, slab, cube };
constexpr const char* kGroundNames[] = {"plane", "slab", "cube"};

struct Case {
  const char* law_name;
  dem_gpu::PolyhedralLaw law;
  Ground ground;
  Attitude attitude;
  Preset preset;
  Vec3 along;  // tangential velocity [m/s]
  Real friction = 0;
};

/// `kPhases` impacts side by side, each first touching at its own part of a step.
Scene impacts(const Case& c, Real restitution) {
  Scene scene = empty_scene(restitution, c.friction);
  scene.energy_ledger = false;
  scene.polyhedral_law = c.law;
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  scene.run.steps_per_contact = promise_of(c.preset).steps_per_contact;
  if (c.ground == Ground::plane) scene.walls = {floor_wall()};
  if (c.ground == Ground::slab) {
    scene.walls = {slab_wall()};
    const auto part = dem_gpu::box_part({kSlabLength, kSlabLength, 0.1});
    scene.walls[0].geometry = dem_gpu::VolumeObject{moved_part(part, {}, {0.9, 0.8, -0.05})};
  }
  scene.bodies = {body_at(0, {})};
  const Real step = time_step(scene);
  scene.bodies.clear();
  const bool is_pair = c.ground == Ground::cube;
  for (int phase = 0; phase < kPhases; ++phase) {
    const Real gap = kSpeed * step * (1.25 + (phase + 0.5) / kPhases), x = kApart * phase;
    const Vec3 down = Vec3{0, 0, is_pair ? -kSpeed / 2 : -kSpeed} + c.along;
    scene.bodies.push_back(body_at(0, {x, 0, c.attitude.half_height + gap}, c.attitude.orientation, down));
    if (is_pair) scene.bodies.push_back(body_at(0, {x, 0, -kEdge / 2}, {}, {0, 0, kSpeed / 2}));
  }
  return scene;
}

/// Largest error of the rebound over the approach speed, with its sign.
double worst_error(const Case& c, Real restitution) {
  const Scene scene = impacts(c, restitution);
  Simulation simulation(scene);
  const int look = static_cast<int>(scene.run.steps_per_contact);
  simulation.advance(look);
  for (int quiet = 0, looks = 0; quiet < 2 && looks < 4000; ++looks) {
    simulation.advance(look);
    quiet = simulation.bulk().contacts > 0 ? 0 : quiet + 1;
  }
  const auto velocity = simulation.snapshot().velocity;
  const std::size_t stride = c.ground == Ground::cube ? 2 : 1;
  double worst = 0;
  for (std::size_t i = 0; i < velocity.size(); i += stride) {
    const double got = (velocity[i].z - (stride == 2 ? velocity[i + 1].z : 0)) / kSpeed;
    if (!(std::abs(got - restitution) <= std::abs(worst))) worst = got - restitution;
  }
  return worst;
}

/// A row of the table; the worst of it stays below what the preset promises.
void expect_promise(const Case& c) {
  const auto promise = promise_of(c.preset);
  std::printf("  %-9s %-6s on %-5s %-9s %s:", c.law_name, c.attitude.name, kGroundNames[static_cast<int>(c.ground)],
              promise.name, norm(c.along) > 0 ? "oblique" : "normal ");
  for (const double asked : kAsked) {
    const double error = worst_error(c, asked);
    std::printf(" %+.4f", error);
    EXPECT_LT(std::abs(error), promise.restitution_error + (c.ground == Ground::slab ? kSingle.late : 0))
        << c.law_name << ", " << c.attitude.name << ", " << promise.name << ", e = " << asked;
  }
  std::printf("\n");
}

void print_head() {
  std::printf("  error of restitution over 12 phases of the step, asked:");
  for (const double asked : kAsked) std::printf("    %.2f", asked);
  std::printf("\n");
}

struct NamedLaw {
  const char* name;
  dem_gpu::PolyhedralLaw law;
};
/// Equally stiff face on face where they touch.
std::vector<NamedLaw> laws() {
  dem_gpu::HardeningDepthPotential hardening;
  hardening.stiffness = kStiffness;
  return {{"depth", dem_gpu::DepthPotential{kStiffness}},
          {"hardening", hardening},
          {"volume", dem_gpu::OverlapVolume{2 * kStiffness}}};
}

TEST(Restitution, OfEveryLawGroundAndPreset) {
  print_head();
  for (const NamedLaw& law : laws())
    for (const Ground ground : {Ground::plane, Ground::slab, Ground::cube})
      for (const Attitude& attitude : kAttitudes)
        for (const Preset preset : {Preset::draft, Preset::standard, Preset::reference})
          expect_promise({law.name, law.law, ground, attitude, preset, {}});
}

TEST(Restitution, OfObliqueImpactsWithoutFriction) {
  // Along a flat ground nothing but the normal force acts.
  print_head();
  for (const NamedLaw& law : laws())
    for (const Ground ground : {Ground::plane, Ground::slab})
      for (const Attitude& attitude : kAttitudes)
        expect_promise({law.name, law.law, ground, attitude, Preset::standard, kAlong});
}

TEST(Restitution, OfObliqueCornersWithFriction) {
  // The centre stands above the corner: friction turns the cube about it, and its impulse has no part along the normal.
  // The corner climbs as it turns, the less the shorter the contact: hence the stiff law. A face is another matter, as
  // friction shifts the load to its front edge.
  print_head();
  for (const Preset preset : {Preset::standard, Preset::reference})
    expect_promise(
        {"depth", dem_gpu::DepthPotential{1e5 * kStiffness}, Ground::plane, kAttitudes[2], preset, kAlong, 0.3});
}

}  // namespace
