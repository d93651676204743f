// SPDX-License-Identifier: Apache-2.0
// A drum as an analytic cylinder and as flat segments: what the facets change.
#include <cmath>
#include <numbers>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;

constexpr double kRadius = 0.1, kLength = 0.07;  // of the drum [m]
constexpr double kCube = 0.02;                   // edge [m]
constexpr double kApart = kLength / 2;           // of the cubes at the start: more than their diagonal [m]
constexpr double kStart = 0.2, kEnd = 0.8;       // cubes settle, then the drum turns [s]

/// Open shell about the y axis of flat segments whose area of cross-section is the cylinder's; normals inward.
catalog::TriangleMesh shell_mesh(int segments) {
  const double turn = 2 * std::numbers::pi / segments;
  const double radius = kRadius * std::sqrt(turn / std::sin(turn));
  catalog::TriangleMesh shell;
  for (const double y : {-kLength, 2 * kLength})
    for (int i = 0; i < segments; ++i)
      shell.vertices.push_back({radius * std::cos(turn * i), y, radius * std::sin(turn * i)});
  for (int i = 0; i < segments; ++i) {
    const int a = i, b = (i + 1) % segments, c = segments + a, d = segments + b;
    shell.faces.push_back({a, b, c});
    shell.faces.push_back({b, d, c});
  }
  return shell;
}

Scene drum_scene(int segments) {
  Scene scene;
  scene.materials = {{"rock", 2700}};
  scene.contact = {{{0.4, 0.5}}};
  scene.polyhedral_law = dem_gpu::DepthPotential{5e8};
  scene.shapes = {dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({kCube, kCube, kCube})})};
  for (int i = 0; i < 18; ++i) {
    dem_gpu::Body body;
    body.position = {kApart * (i % 3 - 1), kApart * (0.5 + i / 3 % 2), kApart * (i / 6) - 0.045};
    body.orientation = dem_gpu::axis_angle({0.6, 0, 0.8}, 0.4 * i);
    scene.bodies.push_back(body);
  }
  dem_gpu::Wall shell, front, back;
  shell.name = "shell";
  if (segments == 0)
    shell.geometry = dem_gpu::Cylinder{{0, -kLength, 0}, {0, 1, 0}, 3 * kLength, kRadius};
  else
    shell.geometry = dem_gpu::MeshObject{shell_mesh(segments), kRadius / 4};
  shell.motion.angular_velocity = {0, 6, 0};
  shell.motion.start_time = kStart;
  shell.motion.ramp_time = 0.1;
  front.name = "front";
  front.geometry = dem_gpu::Plane{{0, 0, 0}, {0, 1, 0}};
  back.name = "back";
  back.geometry = dem_gpu::Plane{{0, kLength, 0}, {0, -1, 0}};
  scene.walls = {shell, front, back};
  scene.run.end_time = kEnd;
  return scene;
}

struct DrumRun {
  double torque = 0;     // mean about the axis over the last half of the turning [N m]
  double work = 0;       // of the shell [J]
  double imbalance = 0;  // of the ledger / throughput
};

DrumRun run_drum(int segments) {
  dem_gpu::Simulation simulation(drum_scene(segments));
  const auto advance_to = [&](double time) {
    simulation.advance(std::llround((time - simulation.time()) / simulation.time_step()));
  };
  advance_to((kStart + kEnd) / 2);
  simulation.take_wall_loads();
  advance_to(kEnd);
  const auto load = simulation.take_wall_loads()[0];
  const auto ledger = simulation.ledger();
  return {load.torque.y, load.work, std::abs(ledger.imbalance()) / ledger.throughput};
}

CaseResult measure_drum(int segments) {
  const DrumRun run = run_drum(segments);
  CaseResult result{{{"mean torque on the shell", run.torque, "N m", {}, ""},
                     {"work of the shell", run.work, "J", {}, ""},
                     {"imbalance of the ledger", run.imbalance, "-", at_most(1e-3), ""}},
                    {}};
  if (segments == 0) return result;
  const DrumRun exact = run_drum(0);
  result.figures.push_back({"torque, change from the cylinder", run.torque / exact.torque - 1, "-", {}, ""});
  result.figures.push_back({"work, change from the cylinder", run.work / exact.work - 1, "-", {}, ""});
  return result;
}

}  // namespace

BenchPlan plan_walls_bench(const BenchOptions&) {
  BenchPlan plan;
  plan.cases = {{"drum-cylinder", [] { return measure_drum(0); }},
                {"drum-64-segments", [] { return measure_drum(64); }},
                {"drum-512-segments", [] { return measure_drum(512); }}};
  return plan;
}

}  // namespace workflows
