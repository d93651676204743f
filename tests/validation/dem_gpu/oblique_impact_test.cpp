// SPDX-License-Identifier: Apache-2.0
// Chung & Ooi (2011), test 5: an elastic sphere of steel on a rigid plane, its tangential speed swept. Where it sticks,
// the rebound depends on the ratio of tangential to normal stiffness alone: Vs' / (mu Vn) is a function of Vs / (mu Vn)
// and of that ratio, 2 (1 - nu) / (2 - nu) = 0.82 after Mindlin.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"

namespace {

using namespace test_support;

constexpr double kFriction = 0.3, kPoisson = 0.3;
constexpr double kMindlin = 2 * (1 - kPoisson) / (2 - kPoisson);

/// Vs' / (mu Vn) by small steps in units of mass, Hertz stiffness and normal speed: d'' = -d^1.5, Vs' = 3.5 T (a solid
/// sphere), |T| <= mu N, T = -ratio (dN/dd) s. The spring keeps its force as it stiffens, its length as it softens.
double rebound_by_integration(double incidence, double ratio) {
  const double largest_depth = std::pow(1.25, 0.4), step = 2.9432751843247 * largest_depth / 40000;
  const auto force = [](double depth) { return std::pow(std::max(depth, 0.0), 1.5); };
  double depth = 0, speed = 1, slip = incidence * kFriction, spring = 0;
  while (true) {
    speed -= step / 2 * force(depth);
    const double before = depth;
    depth += step * speed;
    if (depth <= 0) return slip / kFriction;
    if (before > 0 && depth > before) spring *= std::sqrt(before / depth);
    spring += step * slip;
    const double stiffness = ratio * 1.5 * std::sqrt(depth), limit = kFriction * force(depth);
    if (stiffness * std::abs(spring) > limit) spring = std::copysign(limit / stiffness, spring);
    slip -= step * 3.5 * stiffness * spring;
    speed -= step / 2 * force(depth);
  }
}

/// The same by the engine.
double rebound_by_engine(double incidence, double steps_per_contact) {
  const double radius = 1e-5, normal = 5;
  dem_gpu::Scene scene = empty_scene(1, kFriction);
  scene.materials = {{"steel", 7850, 208e9, kPoisson}, {"rigid", 7850, 208e18, kPoisson}};
  scene.contact.assign(2, {2, {1, kFriction}});
  scene.sphere_law = dem_gpu::Hertz{};
  scene.shapes = {dem_gpu::sphere_shape("ball", radius)};
  scene.bodies = {body_at(0, {0, 0, radius * (1 + 1e-3)}, {}, {incidence * kFriction * normal, 0, -normal})};
  scene.walls = {floor_wall()};
  scene.walls[0].material = 1;
  const double mass = 7850 * scene.shapes[0].volume;
  const double k = 4.0 / 3 * 208e9 / (1 - kPoisson * kPoisson) * std::sqrt(radius);
  scene.run.time_step = 2.9432751843247 / normal * std::pow(1.25 * mass * normal * normal / k, 0.4) / steps_per_contact;
  dem_gpu::Simulation simulation(scene);
  run_impact(simulation);
  const auto after = simulation.snapshot();
  return (after.velocity[0].x - radius * after.angular_velocity[0].y) / (kFriction * normal);
}

TEST(ChungOoi, Test5StickBranchIsThatOfMindlinsStiffness) {
  std::printf("  Vs/(mu Vn): engine at 200 and 800 steps, direct integration\n");
  for (const double incidence : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}) {
    const double coarse = rebound_by_engine(incidence, 200), fine = rebound_by_engine(incidence, 800);
    const double exact = rebound_by_integration(incidence, kMindlin);
    std::printf("  %4.1f: %7.4f %7.4f %7.4f\n", incidence, coarse, fine, exact);
    // 0.3 % of the largest fall of the surface speed, 7: friction's arm is shorter than the radius by half the overlap,
    // up to 0.8 %, which the equations leave out.
    EXPECT_NEAR(coarse, exact, 0.021) << incidence;
    EXPECT_NEAR(fine, exact, 0.021) << incidence;
  }
}

TEST(ChungOoi, Test5DigitisedSteelIsOfLessThanHalfOfMindlinsStiffness) {
  // The curve "Steel" of the published figure, one of two by discrete element codes there, has a rebound of -0.75 at 1
  // where test 4, the same impact but for nu = 0.23, has +0.72. With 0.43 of Mindlin's stiffness the same equations
  // give it; with all of it they do not. (0.25: reading error, and the codes' rule for springs that stiffen.)
  struct Point {
    double incidence, rebound;
  };
  const Point digitised[] = {{0.332, -0.280}, {1.009, -0.747}, {2.0, -1.533},
                             {2.991, -2.440}, {4.006, -2.787}, {4.997, -2.0}};
  double furthest = 0;
  for (const Point& point : digitised) {
    const double got = rebound_by_integration(point.incidence, 0.43 * kMindlin);
    furthest = std::max(furthest, std::abs(rebound_by_integration(point.incidence, kMindlin) - point.rebound));
    std::printf("  %5.3f: digitised %6.3f, 0.43 of Mindlin's stiffness %6.3f\n", point.incidence, point.rebound, got);
    EXPECT_NEAR(got, point.rebound, 0.25);
  }
  EXPECT_GT(furthest, 1);
}

}  // namespace
