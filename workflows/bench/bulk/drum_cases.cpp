// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>
#include <random>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/bulk/bulk_cases.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kDrumRadius = 0.1, kDrumLength = 0.06;  // [m]
constexpr int kLifters = 6;
constexpr double kCube = 0.012;  // [m]
constexpr int kCubes = 120;
/// 70 % of the critical speed sqrt(g / R).
const double kDrumSpeed = 0.7 * std::sqrt(9.81 / kDrumRadius);  // [rad/s]
constexpr int kDrumSteps[] = {10, 20, 40};
constexpr int kDrumReference = 80;

catalog::ConvexPart lifter(int index) {
  const double height = 0.012, width = 0.012;
  catalog::ConvexPart part = dem_gpu::box_part({2 * height, kDrumLength, width});
  const double angle = 2 * std::numbers::pi * index / kLifters;
  const Vec3 outward{std::cos(angle), 0, std::sin(angle)}, along{-std::sin(angle), 0, std::cos(angle)};
  const auto turned = [&](const catalog::Point& p) { return p[0] * outward + Vec3{0, p[1], 0} + p[2] * along; };
  // Half of it stands in the shell.
  const Vec3 centre = kDrumRadius * outward;
  for (catalog::Point& vertex : part.vertices) {
    const Vec3 moved = turned(vertex) + centre;
    vertex = {moved.x, moved.y, moved.z};
  }
  for (catalog::ConvexFace& face : part.faces) {
    const Vec3 normal = turned(face.plane.normal);
    face.plane = {{normal.x, normal.y, normal.z}, face.plane.offset + dot(normal, centre)};
    if (dot(cross(along, outward), Vec3{0, 1, 0}) < 0) std::reverse(face.vertices.begin(), face.vertices.end());
  }
  return part;
}

Scene drum_scene(const NamedLaw& law) {
  Scene scene;
  scene.name = "drum";
  scene.materials = {{"rock", 2700}};
  scene.contact = {{{0.4, 0.5}}};
  scene.shapes = {dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({kCube, kCube, kCube})})};
  dem_gpu::Motion turning;
  turning.angular_velocity = {0, kDrumSpeed, 0};
  turning.start_time = 0.1;
  turning.ramp_time = 0.1;
  dem_gpu::Wall shell;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -kDrumLength / 2, 0}, {0, 1, 0}, kDrumLength, kDrumRadius};
  scene.walls = {shell, plane_wall("left", {0, -kDrumLength / 2, 0}, {0, 1, 0}),
                 plane_wall("right", {0, kDrumLength / 2, 0}, {0, -1, 0})};
  for (int i = 0; i < kLifters; ++i) {
    dem_gpu::Wall wall;
    wall.name = "lifter " + std::to_string(i);
    wall.geometry = dem_gpu::VolumeObject{lifter(i)};
    wall.contact_class = "lifter";
    scene.walls.push_back(wall);
  }
  for (dem_gpu::Wall& wall : scene.walls) wall.motion = turning;
  std::mt19937_64 random(7);
  const double pitch = 1.35 * kCube;
  const int across = 5, deep = 3;
  for (int i = 0; i < kCubes; ++i) {
    dem_gpu::Body body;
    const int column = i % across, row = (i / across) % deep, layer = i / (across * deep);
    body.position = {(column - 0.5 * (across - 1)) * pitch, (row - 0.5 * (deep - 1)) * pitch,
                     -0.55 * kDrumRadius + layer * pitch};
    // Slightly turned, so that no two overlap.
    body.orientation = dem_gpu::axis_angle(random_direction(random), uniform(random, 0, 0.2));
    scene.bodies.push_back(body);
  }
  set_law(scene, law, 1, 0.02);
  return scene;
}

struct DrumRun {
  double power = kFailedRun;      // mean over the last turn [W]
  double spread = kFailedRun;     // standard error of that mean, from the turn's lifter passages [W]
  double imbalance = kFailedRun;  // energy, over throughput
  double overlap = kFailedRun;
  double wall_time = kFailedRun;  // [s]
  std::string failure;
};

DrumRun turn_drum(Scene scene, int steps_per_contact) {
  DrumRun run;
  try {
    scene.run.steps_per_contact = steps_per_contact;
    Simulation simulation(scene);
    const double passage = 2 * std::numbers::pi / kDrumSpeed / kLifters;
    const auto steps = static_cast<std::int64_t>(std::round(passage / simulation.time_step()));
    const WallClock clock;
    simulation.advance(static_cast<std::int64_t>(0.2 / simulation.time_step()) + kLifters * steps / 2);
    simulation.take_wall_loads();
    std::array<double, kLifters> power;
    for (double& mean : power) {
      simulation.advance(steps);
      mean = 0;
      for (const dem_gpu::WallLoad& load : simulation.take_wall_loads()) mean += load.power;
    }
    run.wall_time = clock.seconds();
    run.power = 0;
    for (const double mean : power) run.power += mean / kLifters;
    double square = 0;
    for (const double mean : power) square += (mean - run.power) * (mean - run.power);
    run.spread = std::sqrt(square / (kLifters * (kLifters - 1)));
    const dem_gpu::EnergyLedger ledger = simulation.ledger();
    run.imbalance = std::abs(ledger.imbalance()) / ledger.throughput;
    run.overlap = simulation.quality().largest_overlap;
  } catch (const std::exception& error) {
    run.failure = error.what();
  }
  return run;
}

const DrumRun& drum_reference() {
  static const DrumRun reference = turn_drum(drum_scene(kDepth), kDrumReference);
  return reference;
}

}  // namespace

CaseResult measure_drum(const NamedLaw& law) {
  CaseResult result;
  FigureList figures(result);
  figures.add("power of the reference, " + steps_label(kDrumReference), drum_reference().power, "W",
              drum_reference().failure);
  figures.add("its standard error over the lifter passages", drum_reference().spread, "W", drum_reference().failure);
  PlotCurve curve{"drum", law.name, {}, {}, {}};
  for (const int steps : kDrumSteps) {
    const DrumRun run = turn_drum(drum_scene(law), steps);
    const std::string at = ", " + steps_label(steps);
    const double error = std::abs(run.power / drum_reference().power - 1);
    figures.add("power" + at, run.power, "W", run.failure);
    figures.add("power, relative to the reference" + at, error, "-", run.failure);
    figures.add("energy imbalance over throughput" + at, run.imbalance, "-", run.failure,
                steps == kStandardSteps && !law.is_volume ? std::optional<Goal>(at_most(0.001)) : std::nullopt);
    figures.add("largest overlap over diameter" + at, run.overlap, "-", run.failure);
    figures.add("wall time" + at, run.wall_time, "s", run.failure);
    curve.x.push_back(run.wall_time);
    curve.y.push_back(error);
    curve.point_names.push_back(steps_label(steps));
  }
  result.curves = {curve};
  return result;
}

}  // namespace workflows
