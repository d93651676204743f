// SPDX-License-Identifier: Apache-2.0
// What takes minutes.
#include <algorithm>
#include <cmath>

#include "tests/support/dem_runs.h"
#include "tests/validation/hard_cases/hard_case.h"
#include "tests/validation/hard_cases/tower.h"

namespace hard_cases {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

/// Stiffness k [N/m3] at which a tower of n cubes stands with a margin of four: soft joints buckle under the tower's
/// own weight. A joint of normal stiffness K = 2 k L^2 resists a turn with K L^2 / 12 a joint, an evenly spread bending
/// stiffness of K L^3 / 12; a clamped column of weight q a length buckles at height H where q H^3 = 7.84 times that
/// (Greenhill, Proc. Camb. Phil. Soc. 4 (1881) 65).
Real standing_stiffness(int cubes, Real edge, Real density) {
  constexpr Real kMargin = 4, kGravity = 9.81;
  const Real weight_per_length = density * kGravity * edge * edge, height = cubes * edge;
  return kMargin * 12 * weight_per_length * std::pow(height, 3) / (Real(7.84) * 2 * std::pow(edge, 5));
}

Finding tower(const Tower& tower) {
  Scene scene = empty_scene(0.3, 0.5);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law =
      dem_gpu::DepthPotential{standing_stiffness(tower.cubes, tower.edge, scene.materials[0].density)};
  scene.walls = {floor_wall()};
  scene.shapes = {box_shape({tower.edge, tower.edge, tower.edge})};
  for (int i = 0; i < tower.cubes; ++i)
    scene.bodies.push_back(body_at(0, {0, 0, tower.edge / 2 + tower.gap + i * (tower.edge + tower.gap)}));
  Simulation simulation(scene);
  run_to(simulation, tower.time);
  const auto now = simulation.snapshot();
  double drift = 0, speed = 0;
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    drift = std::max(drift, std::hypot(now.position[i].x, now.position[i].y) / tower.edge);
    speed = std::max(speed, norm(now.velocity[i]));
  }
  return {drift < 0.01 && speed < 1e-6,
          text("fastest %.1e m/s, drift %.1e edges, energy off by %.1e", speed, drift,
               std::abs(simulation.ledger().imbalance()) / simulation.ledger().throughput)};
}

namespace {

/// A cube at rest on an incline at 0.8 of the friction angle.
Finding rest(double seconds) {
  const Real angle = std::atan(0.8 * 0.5);
  Scene scene = empty_scene(0.3, 0.5);
  scene.gravity = {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e7};
  scene.walls = {floor_wall()};
  scene.shapes = {box_shape({0.02, 0.02, 0.02})};
  scene.bodies = {body_at(0, {0, 0, 0.01})};
  Simulation simulation(scene);
  run_to(simulation, 1);
  const auto early = simulation.snapshot();
  run_to(simulation, 1 + seconds);
  const auto late = simulation.snapshot();
  const double creep = norm(late.position[0] - early.position[0]) / seconds;
  return {creep < 1e-8,
          text("creep %.1e m/s over %.0f s, %lld steps", creep, seconds, static_cast<long long>(simulation.step()))};
}

/// Balls in a closed elastic box.
Finding elastic_box(int per_side, double seconds) {
  Scene scene = empty_scene(1, 0);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01), box_shape({0.02, 0.02, 0.02})};
  std::mt19937 random(12);
  const Real cell = 0.044;
  for (int x = 0; x < per_side; ++x)
    for (int y = 0; y < per_side; ++y)
      for (int z = 0; z < per_side; ++z)
        scene.bodies.push_back(body_at((x + y + z) % 2, cell * Vec3{x + 0.5, y + 0.5, z + 0.5}, random_rotation(random),
                                       random_direction(random)));
  scene.walls = room(cell * per_side * Vec3{1, 1, 1});
  Simulation simulation(scene);
  run_to(simulation, seconds);
  const auto ledger = simulation.ledger();
  const double share = std::abs(ledger.imbalance()) / ledger.initial;
  return {share < 1e-3,
          text("%zu bodies, %.3g s: energy off by %.1e at 20 steps a contact", scene.bodies.size(), seconds, share)};
}

}  // namespace

std::vector<HardCase> long_cases() {
  return {{"resting contact on an incline, 20 s", "creep below 1e-8 m/s", true, [] { return rest(20); }},
          {"resting contact on an incline, 10 minutes", "creep below 1e-8 m/s", false, [] { return rest(600); }},
          {"elastic box of 27", "energy to 1e-3 at the standard step", true, [] { return elastic_box(3, 0.3); }},
          {"elastic box of 216", "energy to 1e-3 at the standard step", false, [] { return elastic_box(6, 1); }},
          {"tower of 50 cubes, 60 s", "stands, slower than 1e-6 m/s", false, [] {
             return tower({50, 0.02, 0, 60});
           }}};
}

}  // namespace hard_cases
