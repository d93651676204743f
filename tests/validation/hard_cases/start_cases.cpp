// SPDX-License-Identifier: Apache-2.0
// Scenes that cannot end right as they stand: refused, or stopped with step, bodies and remedy.
#include <cmath>
#include <functional>
#include <stdexcept>

#include "tests/support/dem_runs.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;

/// What `run` is stopped with; empty if it is not.
std::string message_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (message.find(word) == std::string::npos) return false;
  return true;
}

Finding named(const std::string& message, const std::vector<std::string>& words) {
  return {names(message, words), message.empty() ? "went on" : "\"" + message + "\""};
}

Scene two_cubes(Real shift) {
  Scene scene = empty_scene(1, 0);
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  scene.bodies = {body_at(0, {}), body_at(0, {0.001, 0.002, shift})};
  return scene;
}

Finding deep_start_refused() {
  return named(message_of([] { Simulation simulation(two_cubes(0.6 * kEdge)); }),
               {"body 0", "body 1", "overlap", "largest_start_overlap"});
}

Finding deep_start_allowed() {
  Scene scene = two_cubes(0.8 * kEdge);
  scene.run.largest_start_overlap = 1;
  scene.run.steps_per_contact = 80;
  Simulation simulation(scene);
  const double stored = simulation.ledger().initial;
  simulation.advance(16000);
  const auto ledger = simulation.ledger();
  const double error = ledger.kinetic / stored - 1;
  return {stored > 0 && std::abs(error) < 1e-3 && ledger.elastic_normal == 0,
          text("%.4g J stored, kinetic after off by %.1e", stored, error)};
}

Finding concentric_start() {
  return named(message_of([] {
                 Scene scene = two_cubes(0);
                 scene.bodies[1].position = {};
                 Simulation simulation(scene);
               }),
               {"body 0", "body 1", "middle"});
}

Finding start_in_wall() {
  return named(message_of([] {
                 Scene scene = two_cubes(1);
                 scene.walls = {floor_wall()};
                 Simulation simulation(scene);
               }),
               {"body 0", "wall 'floor'", "overlap"});
}

Finding faster_than_its_size() {
  Scene scene = two_cubes(0.5);
  scene.bodies[1].velocity = {0, 0, -1.2 * kEdge / dem_gpu::time_step(scene)};
  return named(message_of([&] { Simulation(scene).advance(10); }), {"step 1", "body 1", "time step of at most"});
}

Finding wall_faster_than_a_body() {
  Scene scene = two_cubes(0.5);
  scene.walls = {floor_wall()};
  std::get<dem_gpu::Plane>(scene.walls[0].geometry).point.z = -1;
  scene.walls[0].motion.velocity = {0, 0, kEdge / dem_gpu::time_step(scene)};
  return named(message_of([&] { Simulation simulation(scene); }), {"wall 'floor'", "body 0", "time step of at most"});
}

Finding step_beyond_a_fifth() {
  Scene scene = two_cubes(0.5);
  scene.run.time_step = 2 * dem_gpu::shortest_contact_time(scene) / 5;
  return named(message_of([&] { Simulation simulation(scene); }), {"time step", "too long", "use at most"});
}

/// Twice the standard step: allowed, and the error is that of 10 steps a contact.
Finding step_twice_the_standard() {
  Scene scene = two_cubes(1.05 * kEdge);
  scene.bodies[1].velocity = {0, 0, -1};
  scene.bodies[1].position.x = scene.bodies[1].position.y = 0;
  scene.run.time_step = dem_gpu::shortest_contact_time(scene) / 10;
  Simulation simulation(scene);
  run_impact(simulation);
  const auto snapshot = simulation.snapshot();
  const double restitution = (snapshot.velocity[1].z - snapshot.velocity[0].z) / 1;
  return {std::abs(restitution - 1) < 5e-3, text("restitution off by %.1e", restitution - 1)};
}

/// A sphere pressed deep between 12 fixed ones of a stiffening law: stiffer than the step was chosen for.
Finding jammed_sphere() {
  Scene scene = empty_scene(1, 0);
  scene.sphere_law = dem_gpu::Hertz{};
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  scene.run.largest_start_overlap = 1;
  scene.run.steps_per_contact = 5;
  scene.bodies = {body_at(0, {}, {}, {0.1, 0.05, 0.02})};
  const Real reach = 0.012 / std::sqrt(Real(2));
  for (const Real s : {-reach, reach})
    for (const Real t : {-reach, reach})
      for (const Vec3& at : {Vec3{0, s, t}, Vec3{s, 0, t}, Vec3{s, t, 0}}) {
        scene.bodies.push_back(body_at(0, at));
        scene.bodies.back().is_fixed = true;
      }
  double share = 0;
  const std::string message = message_of([&] {
    Simulation simulation(scene);
    simulation.advance(20000);
    const auto ledger = simulation.ledger();
    share = std::abs(ledger.imbalance()) / ledger.throughput;
  });
  if (!message.empty()) return named(message, {"step ", "body 0", "time step"});
  return {share < 0.01, text("went on, energy off by %.1e", share)};
}

}  // namespace

std::vector<HardCase> start_cases() {
  return {{"start in deep overlap", "refused, bodies and remedy named", true, deep_start_refused},
          {"deep overlap asked for", "stored energy comes back to 1e-3", true, deep_start_allowed},
          {"start one in the other's middle", "refused, bodies named", true, concentric_start},
          {"start inside a wall", "refused, body and wall named", true, start_in_wall},
          {"body faster than its size per step", "stops with step, body, remedy", true, faster_than_its_size},
          {"wall faster than a body's size per step", "refused with remedy", true, wall_faster_than_a_body},
          {"step beyond a fifth of the contact", "refused with the step to use", true, step_beyond_a_fifth},
          {"time step twice the standard", "restitution to 5e-3", true, step_twice_the_standard},
          {"jammed sphere, stiffer than foreseen", "energy to 1 %, or stops by name", true, jammed_sphere}};
}

}  // namespace hard_cases
