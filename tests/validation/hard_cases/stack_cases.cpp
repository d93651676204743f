// SPDX-License-Identifier: Apache-2.0
// Bodies that stand, lean, hang and rest.
#include <algorithm>
#include <cmath>

#include "tests/support/dem_runs.h"
#include "tests/validation/hard_cases/hard_case.h"
#include "tests/validation/hard_cases/tower.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

/// Bricks of length 1 (in units of 0.1 m), each shifted against the one below by `share` of the harmonic overhang
/// L / 2 (1 + 1/2 + ... + 1/n): below 1 the stack stands, above it falls.
double top_sinks(Real share) {
  constexpr int kBricks = 4;
  constexpr Real kLength = 0.1, kHeight = 0.02;
  Scene scene = empty_scene(0.2, 0.6);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e11};  // the strips that carry are thin
  scene.shapes = {box_shape({kLength, 0.05, kHeight})};
  Real x = 0;
  for (int i = 0; i < kBricks; ++i) {
    scene.bodies.push_back(body_at(0, {x, 0, (i + Real(0.5)) * kHeight}));
    scene.bodies.back().is_fixed = i == 0;
    x += share * kLength / 2 / (kBricks - 1 - i);
  }
  Simulation simulation(scene);
  run_to(simulation, 0.3);
  return (scene.bodies.back().position.z - simulation.snapshot().position.back().z) / kHeight;
}

Finding leaning_stack() {
  const double stands = top_sinks(0.95), falls = top_sinks(1.05);
  return {stands < 0.01 && falls > 0.05, text("at 0.95 of the overhang the top sinks %.1e brick heights in 0.3 s, at "
                                              "1.05 %.2g",
                                              stands, falls)};
}

/// Body of seven cubes of 10 mm: three sides of a square of 30 mm in the xz plane, open at the top or at the bottom,
/// its axes kept (it is symmetric about x = 0 and y = 0, so they are principal).
dem_gpu::Shape hook(bool opens_up) {
  constexpr Real kBar = 0.01, kCube = kBar * kBar * kBar;
  const int bar = opens_up ? 0 : 2;
  std::vector<std::array<int, 3>> cells{{0, 0, bar}, {1, 0, bar}, {2, 0, bar}};
  for (int z = 0; z < 3; ++z)
    if (z != bar) cells.insert(cells.end(), {{0, 0, z}, {2, 0, z}});
  // Mean height of the seven cells, counted from the middle one, is -2 / 7 or 2 / 7 of a bar.
  const Real shift = kBar * (opens_up ? 2 : -2) / 7;
  const std::vector<Real> along_x{-1.5 * kBar, -0.5 * kBar, 0.5 * kBar, 1.5 * kBar};
  std::vector<Real> along_z = along_x;
  for (Real& z : along_z) z += shift;
  Vec3 inertia;
  for (const auto& cell : cells) {
    const Real x = kBar * (cell[0] - 1), z = kBar * (cell[2] - 1) + shift, own = kCube * kBar * kBar / 6;
    inertia += Vec3{own + kCube * z * z, own + kCube * (x * x + z * z), own + kCube * x * x};
  }
  return {"hook", dem_gpu::PolyhedralShape{grid_parts(cells, {along_x, {-kBar / 2, kBar / 2}, along_z})},
          static_cast<Real>(cells.size()) * kCube, inertia};
}

/// A frictionless hook hangs in another, turned by 90 degrees, that is held; pulled down it stays, pushed up it leaves.
Finding hooked_bodies() {
  const auto pulled = [](Real gravity) {
    Scene scene = empty_scene(0.3, 0);
    scene.gravity = {0, 0, gravity};
    scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
    scene.shapes = {hook(true), hook(false)};
    // Bar on bar, 0.1 mm apart: the held hook's bar is the middle of its low side, along x; the hanging one's, turned
    // by 90 degrees, lies above it along y, its legs down on either side.
    const Real shift = 0.01 * 2 / 7;
    scene.bodies = {body_at(0, {0, 0, -shift}),
                    body_at(1, {0, 0, -0.01 + shift + 0.0001}, dem_gpu::axis_angle({0, 0, 1}, M_PI / 2))};
    scene.bodies[0].is_fixed = true;
    const Vec3 start = scene.bodies[1].position;
    Simulation simulation(scene);
    run_to(simulation, 0.5);
    return simulation.snapshot().position[1] - start;
  };
  const Vec3 down = pulled(-9.81), up = pulled(9.81);
  return {norm(down) < 1e-3 && up.z > 1,
          text("pulled down moves %.1e m, pushed up leaves by %.2f m", double(norm(down)), double(up.z))};
}

/// Slabs and cubes of falling size in a pile, dropped from 1 mm each.
Finding mixed_stack() {
  Scene scene = empty_scene(0.2, 0.6);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.walls = {floor_wall()};
  const Vec3 sizes[] = {
      {0.1, 0.1, 0.02}, {0.04, 0.04, 0.04}, {0.06, 0.03, 0.01}, {0.01, 0.01, 0.01}, {0.03, 0.03, 0.003}};
  Real height = 0;
  for (const Vec3& size : sizes) {
    scene.shapes.push_back(box_shape(size));
    height += 0.0002;
    scene.bodies.push_back(body_at(static_cast<int>(scene.shapes.size()) - 1, {0, 0, height + size.z / 2}));
    height += size.z;
  }
  Simulation simulation(scene);
  run_to(simulation, 1);
  const auto now = simulation.snapshot();
  double drift = 0, speed = 0;
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    drift = std::max(drift, std::hypot(now.position[i].x, now.position[i].y));
    speed = std::max(speed, norm(now.velocity[i]));
  }
  return {drift < 1e-5 && speed < 1e-4, text("after 1 s: drift %.1e m, fastest %.1e m/s", drift, speed)};
}

}  // namespace

std::vector<HardCase> stack_cases() {
  return {{"leaning stack of 4", "stands at 0.95 of the harmonic overhang, falls at 1.05", true, leaning_stack},
          {"hooked bodies without friction", "hold when pulled, come free the open way", true, hooked_bodies},
          {"stack of mixed sizes", "rests, drift below 10 um", true, mixed_stack},
          {"tower of 10 cubes, 2 s", "stands, slower than 1e-6 m/s", true,
           [] {
             return tower({10, 0.02, 0, 2});
           }},
          {"aligned tower of 20, gaps 1 mm, 3 s", "stands, slower than 1e-6 m/s", false, [] {
             return tower({20, 0.1, 0.001, 3});
           }}};
}

}  // namespace hard_cases
