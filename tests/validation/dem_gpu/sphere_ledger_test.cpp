// SPDX-License-Identifier: Apache-2.0
// The ledger of damped spheres keeps what the presets promise: single bounces of any restitution and phase, a ball in a
// corner, a pile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <string>

#include "dem_gpu/run_promise.h"
#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Preset;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kRadius = 0.01;       // [m]
constexpr int kMostSteps = 600;      // without restitution a ball leaves by creeping
constexpr double kSpringLeft = 0.1;  // of the promise: what stiffening springs may give back
constexpr Preset kPresets[] = {Preset::draft, Preset::standard, Preset::reference};

struct SphereCase {
  bool is_hertz;
  double adhesion;  // work of [J/m2]

  friend void PrintTo(const SphereCase& one, std::ostream* out) {
    *out << (one.is_hertz ? "Hertz" : "linear") << (one.adhesion > 0 ? ", adhesive" : "");
  }
};

Scene scene_of(const SphereCase& one, double restitution, double friction, Preset preset) {
  Scene scene = empty_scene(restitution, friction);
  scene.materials[0].youngs_modulus = 1e8;
  scene.contact[0][0].adhesion = one.adhesion;
  if (one.is_hertz) scene.sphere_law = dem_gpu::Hertz{};
  scene.shapes = {dem_gpu::sphere_shape("ball", kRadius), dem_gpu::sphere_shape("pebble", kRadius / 3)};
  scene.run.preset = preset;
  scene.run.steps_per_contact = dem_gpu::promise_of(preset).steps_per_contact;
  return scene;
}

double imbalance_share(const Simulation& simulation) {
  const auto ledger = simulation.ledger();
  return ledger.imbalance() / ledger.throughput;
}

class SphereLedger : public testing::TestWithParam<SphereCase> {};

TEST_P(SphereLedger, ClosesOverABounce) {
  for (const Preset preset : kPresets) {
    const dem_gpu::Promise promise = dem_gpu::promise_of(preset);
    double worst = 0, least_shear = 0;
    for (const char* partner : {"plane", "ball", "pebble"})
      for (const double restitution : {0.05, 0.2, 0.5, 0.8, 0.95})
        for (const double slide : {0.0, 0.7})
          for (int phase = 0; phase < 8; ++phase) {
            Scene scene = scene_of(GetParam(), restitution, 0.4, preset);
            scene.run.steps_per_contact *= 1 + 0.02 * phase;
            scene.bodies = {body_at(0, {0, 0, 1.0001 * kRadius}, {}, {slide, 0, -1})};
            if (partner == std::string("plane"))
              scene.walls = {floor_wall()};
            else if (partner == std::string("ball"))
              scene.bodies.push_back(body_at(0, {0.2 * kRadius, 0, -0.99 * kRadius}));
            else
              scene.bodies.push_back(body_at(1, {0, 0, -kRadius / 3}));
            Simulation simulation(scene);
            run_impact(simulation, kMostSteps);
            worst = std::max(worst, std::abs(imbalance_share(simulation)));
            const auto ledger = simulation.ledger();
            for (const auto& loss : ledger.dissipation)
              least_shear = std::min(least_shear, loss.shear / ledger.initial);
          }
    std::printf("  %-9s: largest imbalance of a bounce %.1e of the energy put in (promised %.0e)\n", promise.name,
                worst, promise.energy_imbalance);
    EXPECT_LT(worst, promise.energy_imbalance) << promise.name;
    EXPECT_GT(least_shear, -kSpringLeft * promise.energy_imbalance) << promise.name << ": friction only dissipates";
  }
}

TEST_P(SphereLedger, ClosesInACorner) {
  // A ball that strikes three planes, each at its own time: the friction of one is news to the others.
  for (const Preset preset : kPresets) {
    const dem_gpu::Promise promise = dem_gpu::promise_of(preset);
    double worst = 0;
    for (const double restitution : {0.05, 0.2, 0.5, 0.9})
      for (int phase = 0; phase < 8; ++phase) {
        Scene scene = scene_of(GetParam(), restitution, 0.3, preset);
        scene.run.steps_per_contact *= 1 + 0.02 * phase;
        scene.walls = room({0.1, 0.1, 0.1});
        scene.bodies = {body_at(0, kRadius * Vec3{1.0001, 1.0004, 1.0009}, {}, Vec3{-0.5, -0.9, -0.7 - 0.1 * phase})};
        Simulation simulation(scene);
        run_impact(simulation, kMostSteps);
        worst = std::max(worst, std::abs(imbalance_share(simulation)));
      }
    std::printf("  %-9s: largest imbalance in a corner %.1e of the energy put in (promised %.0e)\n", promise.name,
                worst, promise.energy_imbalance);
    EXPECT_LT(worst, promise.energy_imbalance) << promise.name;
  }
}

TEST_P(SphereLedger, ClosesInAPile) {
  for (const double restitution : {0.05, 0.5})
    for (const Preset preset : {Preset::standard, Preset::reference}) {
      const dem_gpu::Promise promise = dem_gpu::promise_of(preset);
      Scene scene = scene_of(GetParam(), restitution, 0.5, preset);
      scene.gravity = {0, 0, -9.81};
      scene.sphere_law = GetParam().is_hertz ? scene.sphere_law : dem_gpu::LinearSpring{5e3};
      scene.materials[0].youngs_modulus = 2e6;
      const Real cell = 2.1 * kRadius;
      std::mt19937 random(5);
      for (int i = 0; i < 27; ++i)
        scene.bodies.push_back(body_at(i % 4 == 0 ? 1 : 0, cell * Vec3{i % 3 + 0.5, i / 3 % 3 + 0.5, i / 9 + 0.5}, {},
                                       0.2 * random_direction(random)));
      scene.walls = room(cell * Vec3{3, 3, 6});
      Simulation simulation(scene);
      double worst = 0;
      for (int k = 1; k <= 10; ++k) {
        run_to(simulation, 0.03 * k);
        worst = std::max(worst, std::abs(imbalance_share(simulation)));
      }
      std::printf(
          "  %-9s: imbalance of a pile of 27 at restitution %.2f at most %.1e of the energy put in (promised %.0e)\n",
          promise.name, restitution, worst, promise.energy_imbalance);
      EXPECT_LT(worst, promise.energy_imbalance) << promise.name;
      EXPECT_LT(simulation.ledger().kinetic, 0.03 * simulation.ledger().throughput) << "comes to rest";
    }
}

TEST_P(SphereLedger, ClosesForABallThatIsDropped) {
  for (const double restitution : {0.0, 0.05, 0.4})
    for (const double drop : {1e-3, 5e-3}) {
      const dem_gpu::Promise promise = dem_gpu::promise_of(Preset::standard);
      Scene scene = scene_of(GetParam(), restitution, 0.3, Preset::standard);
      scene.gravity = {0, 0, -9.81};
      scene.walls = {floor_wall()};
      scene.bodies = {body_at(0, {0, 0, kRadius + drop})};
      Simulation simulation(scene);
      run_to(simulation, 0.06);
      EXPECT_LT(std::abs(imbalance_share(simulation)), promise.energy_imbalance)
          << "restitution " << restitution << " from " << drop << " m";
    }
}

TEST_P(SphereLedger, AVerticalImpactTurnsIntoNoSlide) {
  for (const Preset preset : kPresets)
    for (const double restitution : {0.0, 0.02, 0.1, 0.5}) {
      Scene scene = scene_of(GetParam(), restitution, 1, preset);
      scene.walls = {floor_wall()};
      scene.bodies = {body_at(0, {0.3, 0.1, 1.0001 * kRadius}, {}, {0, 0, -1})};
      Simulation simulation(scene);
      run_impact(simulation, kMostSteps);
      const auto now = simulation.snapshot();
      EXPECT_LT(std::hypot(now.velocity[0].x, now.velocity[0].y), 1e-9) << restitution;
      EXPECT_LT(norm(now.angular_velocity[0]), 1e-6) << restitution;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, SphereLedger,
                         testing::Values(SphereCase{false, 0}, SphereCase{true, 0}, SphereCase{false, 0.05},
                                         SphereCase{true, 0.05}));

}  // namespace
