// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <exception>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/bulk/bulk_cases.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kThrowTime = 0.15;  // [s]
constexpr int kPathPoints = 15;      // compared along the path
constexpr int kThrowSteps[] = {5, 10, 20, 40, 80};
constexpr int kThrowReference = 640;
const Vec3 kBlock{0.02, 0.014, 0.01};  // [m]

Scene thrown_block(const NamedLaw& law, int parts_along) {
  Scene scene;
  scene.name = "thrown block";
  scene.materials = {{"stone", 2500}};
  scene.contact = {{{0.4, 0.4}}};
  const dem_gpu::Shape cut = cut_box_shape(kBlock, {parts_along, parts_along, parts_along});
  scene.shapes = {dem_gpu::polyhedral_shape("block", std::get<dem_gpu::PolyhedralShape>(cut.geometry).parts)};
  // A slab and not a plane: on a plane both laws are the same.
  dem_gpu::Wall floor;
  floor.name = "floor";
  floor.geometry = dem_gpu::VolumeObject{shifted(dem_gpu::box_part({1, 1, 0.1}), {0, 0, -0.05})};
  scene.walls = {floor};
  dem_gpu::Body block;
  block.position = {0, 0, 0.018};
  // polyhedral_shape() puts the principal axes along x, y, z: which edge lies along which follows from the inertia.
  block.orientation = dem_gpu::axis_angle({0.36, 0.48, 0.8}, 0.7);
  block.velocity = {0.6, 0.2, -0.3};
  block.angular_velocity = {4, 9, -3};
  scene.bodies = {block};
  set_law(scene, law, 0.6, 0.02);
  return scene;
}

struct ThrowRun {
  std::vector<Vec3> path;  // kPathPoints
  double wall_time = kFailedRun;
  double imbalance = kFailedRun;  // over throughput
  std::string failure;
};

ThrowRun throw_block(Scene scene, int steps_per_contact) {
  ThrowRun run;
  try {
    const double coarsest = dem_gpu::shortest_contact_time(scene) / steps_per_contact;
    const auto between = static_cast<std::int64_t>(std::ceil(kThrowTime / kPathPoints / coarsest));
    scene.run.time_step = kThrowTime / kPathPoints / static_cast<double>(between);
    Simulation simulation(scene);
    const WallClock clock;
    for (int point = 0; point < kPathPoints; ++point) {
      simulation.advance(between);
      run.path.push_back(simulation.snapshot().position[0]);
    }
    run.wall_time = clock.seconds();
    const dem_gpu::EnergyLedger ledger = simulation.ledger();
    run.imbalance = std::abs(ledger.imbalance()) / ledger.throughput;
  } catch (const std::exception& error) {
    run.failure = error.what();
  }
  return run;
}

/// Largest distance between two paths over the block's longest edge.
double path_error(const ThrowRun& run, const ThrowRun& reference) {
  if (!run.failure.empty() || !reference.failure.empty()) return kFailedRun;
  double largest = 0;
  for (int point = 0; point < kPathPoints; ++point)
    largest = std::max(largest, norm(run.path[point] - reference.path[point]));
  return largest / kBlock.x;
}

}  // namespace

CaseResult measure_throw(const NamedLaw& law, int parts_along) {
  const Scene scene = thrown_block(law, parts_along);
  const ThrowRun reference = throw_block(scene, kThrowReference);
  CaseResult result;
  FigureList figures(result);
  const int parts = parts_along * parts_along * parts_along;
  PlotCurve curve{"throw", std::string(law.name) + (parts > 1 ? ", 8 parts" : ", 1 part"), {}, {}, {}};
  for (const int steps : kThrowSteps) {
    const ThrowRun run = throw_block(scene, steps);
    const std::string at = ", " + steps_label(steps);
    const double error = path_error(run, reference);
    figures.add("path, largest distance over size" + at, error, "-", run.failure,
                steps == kStandardSteps && !law.is_volume ? std::optional<Goal>(at_most(0.05)) : std::nullopt);
    figures.add("energy imbalance over throughput" + at, run.imbalance, "-", run.failure);
    figures.add("wall time" + at, 1e3 * run.wall_time, "ms", run.failure);
    curve.x.push_back(run.wall_time);
    curve.y.push_back(error);
    curve.point_names.push_back(steps_label(steps));
  }
  result.curves = {curve};
  return result;
}

}  // namespace workflows
