// SPDX-License-Identifier: Apache-2.0
// The hardening depth potential: it lands as deep as its stiffness was chosen for, and bounces as asked.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/cube_attitudes.h"
#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::HardeningDepthPotential;
using dem_gpu::OverlapAt;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;  // of the cube [m]
const Real kDiameter = kEdge * std::cbrt(6 / std::numbers::pi);

const auto [kFace, kEdgeDown, kCorner] = cube_attitudes(kEdge);

/// A cube about to strike a plane, or a slab, at `speed`.
Scene landing(const Attitude& attitude, double restitution, double speed, bool on_slab) {
  Scene scene = empty_scene(restitution, 0);
  scene.polyhedral_law = HardeningDepthPotential{dem_gpu::DepthPotential{1e9}, 0.01, 0.01};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  scene.walls = {on_slab ? slab_wall() : floor_wall()};
  scene.bodies = {body_at(0, {0.013, -0.007, attitude.half_height + 1e-6}, attitude.orientation, {0, 0, -speed})};
  scene.run.steps_per_contact = 100;
  return scene;
}

TEST(HardeningLaw, LandsAsDeepAsItsStiffnessWasChosenFor) {
  // Elastic, so 1/2 m v^2 is the energy of the overlap; 1e-3: the step's share of the largest overlap.
  for (const auto& [attitude, at] : {std::pair{kFace, OverlapAt::face}, {kCorner, OverlapAt::corner}})
    for (const double hardening : {0.0, 0.003, 0.03, 0.3}) {
      const double speed = 0.5, overlap = 0.03;
      Scene scene = landing(attitude, 1, speed, false);
      if (hardening > 0)
        scene.polyhedral_law = HardeningDepthPotential{dem_gpu::DepthPotential{1}, hardening, overlap};
      else
        scene.polyhedral_law = dem_gpu::DepthPotential{1};
      const double stiffness = stiffness_for_overlap(scene, speed, overlap, at);
      std::visit([&](auto& law) { law.stiffness = stiffness; }, scene.polyhedral_law);
      if (at == OverlapAt::face) {
        EXPECT_NEAR(flat_overlap(scene, speed), overlap, 1e-12);
      }
      if (auto* law = std::get_if<HardeningDepthPotential>(&scene.polyhedral_law))
        law->flat_overlap = flat_overlap(scene, speed);
      Simulation simulation(scene);
      const Impact impact = run_impact(simulation);
      EXPECT_NEAR(impact.largest_overlap / (overlap * kDiameter), 1, 1e-3) << attitude.name << " " << hardening;
      EXPECT_NEAR(simulation.snapshot().velocity[0].z, speed, 1e-3 * speed);
      // The step was chosen for it: the contact takes at least the steps asked for.
      EXPECT_GT(simulation.quality().smallest_steps_per_contact, 0.99 * 100) << attitude.name << " " << hardening;
    }
}

TEST(HardeningLaw, BouncesAsAsked) {
  for (const bool on_slab : {false, true})
    for (const Attitude& attitude : {kFace, kEdgeDown, kCorner})
      for (const double asked : {0.3, 0.5, 0.8, 1.0})
        for (const double speed : {0.1, 1.0}) {
          Simulation simulation(landing(attitude, asked, speed, on_slab));
          run_impact(simulation);
          const double got = simulation.snapshot().velocity[0].z / speed;
          std::printf("  %-6s on %-5s at %.1f m/s: asked %.1f, got %.4f\n", attitude.name, on_slab ? "slab" : "plane",
                      speed, asked, got);
          EXPECT_NEAR(got, asked, 0.01) << attitude.name << (on_slab ? " on slab" : " on plane");
        }
}

}  // namespace
