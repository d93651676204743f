// SPDX-License-Identifier: Apache-2.0
// Normal impacts: restitution asked for is restitution got; Hertz contacts against their closed form.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/cube_attitudes.h"
#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;  // of the cube [m]

/// Rebound over approach speed of body 0 falling on what stands at z < 0.
double rebound(Scene scene, double speed) {
  scene.run.steps_per_contact = 40;
  Simulation simulation(scene);
  run_impact(simulation);
  return simulation.snapshot().velocity[0].z / speed;
}

const std::array<Attitude, 3> kAttitudes = cube_attitudes(kEdge);
constexpr double kAsked[] = {0.3, 0.5, 0.8, 1.0};

TEST(NormalBounce, CubeOnPlaneAndOnSlab) {
  for (const bool on_slab : {false, true})
    for (const Attitude& attitude : kAttitudes)
      for (const double asked : kAsked)
        for (const double speed : {0.1, 1.0}) {
          Scene scene = empty_scene(asked, 0);
          scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
          scene.walls = {on_slab ? slab_wall() : floor_wall()};
          // Off the middle of the slab's top, so that no symmetry helps.
          scene.bodies = {
              body_at(0, {0.013, -0.007, attitude.half_height + 1e-5}, attitude.orientation, {0, 0, -speed})};
          const double got = rebound(scene, speed);
          std::printf("  %-6s on %-5s at %.1f m/s: asked %.1f, got %.4f\n", attitude.name, on_slab ? "slab" : "plane",
                      speed, asked, got);
          EXPECT_NEAR(got, asked, 0.01) << attitude.name << (on_slab ? " on slab" : " on plane");
        }
}

TEST(NormalBounce, CubeOnEqualCube) {
  // Two free cubes, the upper one flat, edge or vertex first onto the lower one's face; and edge across edge.
  struct Pair {
    const char* name;
    Attitude upper;
    Quaternion lower;
    Real lower_half_height;
  };
  const Quaternion across = dem_gpu::axis_angle({0, 1, 0}, std::numbers::pi / 4);
  const Pair pairs[] = {{"face", kAttitudes[0], {}, kEdge / 2},
                        {"edge", kAttitudes[1], {}, kEdge / 2},
                        {"vertex", kAttitudes[2], {}, kEdge / 2},
                        {"edge on edge", kAttitudes[1], across, kEdge / std::numbers::sqrt2}};
  for (const Pair& pair : pairs)
    for (const double asked : kAsked) {
      const Attitude& attitude = pair.upper;
      Scene scene = empty_scene(asked, 0);
      scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
      scene.bodies = {body_at(0, {0, 0, attitude.half_height + 1e-5}, attitude.orientation, {0, 0, -0.5}),
                      body_at(0, {0, 0, -pair.lower_half_height}, pair.lower, {0, 0, 0.5})};
      scene.run.steps_per_contact = 40;
      Simulation simulation(scene);
      run_impact(simulation);
      const auto velocity = simulation.snapshot().velocity;
      const double got = velocity[0].z - velocity[1].z;
      std::printf("  %-12s on a free cube: asked %.1f, got %.4f\n", pair.name, asked, got);
      EXPECT_NEAR(got, asked, 0.01) << pair.name;
      EXPECT_NEAR(velocity[0].z + velocity[1].z, 0, 1e-12) << "momentum";
    }
}

TEST(NormalBounce, Spheres) {
  for (const bool hertz : {false, true})
    for (const bool on_plane : {true, false})
      for (const double asked : kAsked) {
        Scene scene = empty_scene(asked, 0);
        scene.materials[0].youngs_modulus = 1e8;
        if (hertz) scene.sphere_law = dem_gpu::Hertz{};
        scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
        scene.bodies = {body_at(0, {0, 0, 0.01001}, {}, {0, 0, -1})};
        if (on_plane)
          scene.walls = {floor_wall()};
        else
          scene.bodies.push_back(body_at(0, {0, 0, -0.01}));
        for (const double steps : {20.0, 40.0}) {
          scene.run.steps_per_contact = steps;
          Simulation simulation(scene);
          run_impact(simulation);
          const auto velocity = simulation.snapshot().velocity;
          const double got = on_plane ? velocity[0].z : velocity[0].z - velocity[1].z;
          std::printf("  sphere on %-6s, %-6s, %3.0f steps: asked %.1f, got %.5f\n", on_plane ? "plane" : "sphere",
                      hertz ? "Hertz" : "linear", steps, asked, got);
          EXPECT_NEAR(got, asked, 1e-4);
        }
      }
}

TEST(ChungOoi, Test1TwoEqualSpheres) {
  // Chung & Ooi (2011) test 1: R 10 mm, +-10 m/s. Closed form of Hertz (Johnson 1985, section 11.4).
  struct Row {
    const char* name;
    double modulus, poisson, density, overlap, force, time;
  };
  const Row rows[] = {{"glass", 48e9, 0.20, 2800, 274.1127021e-6, 10.69688898e3, 40.33945569e-6},
                      {"limestone", 20e9, 0.25, 2500, 368.3040256e-6, 7.10824128e3, 54.20100493e-6}};
  for (const Row& row : rows) {
    Scene scene = empty_scene(1, 0);
    scene.materials = {{row.name, row.density, row.modulus, row.poisson}};
    scene.sphere_law = dem_gpu::Hertz{};
    scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
    scene.bodies = {body_at(0, {0, 0, 0.0100001}, {}, {0, 0, -10}), body_at(0, {0, 0, -0.0100001}, {}, {0, 0, 10})};
    scene.run.time_step = row.time / 1000;
    Simulation simulation(scene);
    const Impact impact = run_impact(simulation);
    std::printf("  test 1 %-9s: overlap %.6f of exact, force %.6f, time %.5f\n", row.name,
                impact.largest_overlap / row.overlap, impact.peak_force / row.force, impact.contact_time / row.time);
    EXPECT_NEAR(impact.largest_overlap / row.overlap, 1, 1e-5);
    EXPECT_NEAR(impact.peak_force / row.force, 1, 1e-5);
    EXPECT_NEAR(impact.contact_time / row.time, 1, 2e-3);
    EXPECT_NEAR(simulation.snapshot().velocity[0].z, 10, 1e-4);
  }
}

TEST(ChungOoi, Test2SphereOnRigidPlane) {
  struct Row {
    const char* name;
    double modulus, poisson, density, overlap, force, time;
  };
  const Row rows[] = {{"Al alloy", 70e9, 0.30, 2699, 49.71717524e-6, 11.36985831e3, 731.6566406e-6},
                      {"Mg alloy", 40e9, 0.35, 1800, 52.12328832e-6, 7.232681026e3, 767.0659052e-6}};
  for (const Row& row : rows) {
    Scene scene = empty_scene(1, 0);
    scene.materials = {{row.name, row.density, row.modulus, row.poisson}, {"rigid", 1, 1e30, 0}};
    scene.contact.assign(2, {{1, 0}, {1, 0}});
    scene.sphere_law = dem_gpu::Hertz{};
    scene.shapes = {dem_gpu::sphere_shape("ball", 0.1)};
    scene.walls = {floor_wall()};
    scene.walls[0].material = 1;
    scene.bodies = {body_at(0, {0, 0, 0.1000001}, {}, {0, 0, -0.2})};
    scene.run.time_step = row.time / 1000;
    Simulation simulation(scene);
    const Impact impact = run_impact(simulation);
    std::printf("  test 2 %-9s: overlap %.6f of exact, force %.6f, time %.5f\n", row.name,
                impact.largest_overlap / row.overlap, impact.peak_force / row.force, impact.contact_time / row.time);
    EXPECT_NEAR(impact.largest_overlap / row.overlap, 1, 1e-5);
    EXPECT_NEAR(impact.peak_force / row.force, 1, 1e-5);
    EXPECT_NEAR(impact.contact_time / row.time, 1, 2e-3);
  }
}

TEST(PolyhedronImpact, OverlapAndContactTimeOfPowerLaws) {
  // F = K d^n of a cube on a plane (benchmarks of a volume law, K = 2 k here): d_max = ((n+1) m v^2 / 2K)^(1/(n+1)),
  // t = c_n d_max / v.
  const double stiffness = 2e9, mass = 2500 * kEdge * kEdge * kEdge, speed = 0.5;
  const double n[] = {1, 2, 3}, factor[] = {kEdge * kEdge, kEdge, std::sqrt(3.0) / 2};
  const double time_factor[] = {std::numbers::pi, 2.80436421065091, 2.62205755429212};
  for (int i = 0; i < 3; ++i) {
    Scene scene = empty_scene(1, 0);
    scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
    scene.walls = {floor_wall()};
    scene.bodies = {body_at(0, {0, 0, kAttitudes[i].half_height + 1e-6}, kAttitudes[i].orientation, {0, 0, -speed})};
    scene.run.steps_per_contact = 200;
    Simulation simulation(scene);
    const Impact impact = run_impact(simulation);
    const double depth = std::pow((n[i] + 1) * mass * speed * speed / (2 * stiffness * factor[i]), 1 / (n[i] + 1));
    EXPECT_NEAR(impact.largest_overlap / depth, 1, 1e-4) << kAttitudes[i].name;
    EXPECT_NEAR(impact.contact_time / (time_factor[i] * depth / speed), 1, 0.01) << kAttitudes[i].name;
  }
}

TEST(EccentricImpact, EdgeOffTheCentre) {
  // Rigid limit of a frictionless cube, edge down, tilted: f = 1 / (1 + 6 d^2 / a^2), v' = -v + (1 + e) f v,
  // omega' = (1 + e) f v 6 d / a^2; the error falls with stiffness.
  const double a = kEdge, theta = 20 * std::numbers::pi / 180;
  const double d = a / std::numbers::sqrt2 * std::sin(std::numbers::pi / 4 - theta), f = 1 / (1 + 6 * d * d / (a * a));
  for (const double e : {1.0, 0.5}) {
    double last_error = 1;
    for (const double stiffness : {1e10, 1e13}) {
      Scene scene = empty_scene(e, 0);
      scene.polyhedral_law = dem_gpu::DepthPotential{stiffness};
      scene.shapes = {box_shape({a, a, a})};
      scene.walls = {floor_wall()};
      const double height = a / std::numbers::sqrt2 * std::cos(std::numbers::pi / 4 - theta);
      scene.bodies = {body_at(0, {0, 0, height + 1e-7}, dem_gpu::axis_angle({0, 1, 0}, theta), {0, 0, -1})};
      scene.run.steps_per_contact = 40;
      Simulation simulation(scene);
      run_impact(simulation);
      const auto after = simulation.snapshot();
      const double error =
          std::max(std::abs(after.velocity[0].z - (-1 + (1 + e) * f)),
                   std::abs(std::abs(after.angular_velocity[0].y) * a / ((1 + e) * f * 6 * d / a) - 1));
      std::printf("  eccentric edge, e %.1f, k %.0e: error %.2e\n", e, stiffness, error);
      EXPECT_LT(error, last_error);
      last_error = error;
    }
    EXPECT_LT(last_error, 0.01);
  }
}

}  // namespace
