// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <exception>
#include <random>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/bulk/bulk_cases.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr int kFiner = 16;  // the reference, against the standard step
constexpr int kGrains = 500;
constexpr double kGrainSize = 0.01;    // diameter of the sphere of an L's volume, about [m]
constexpr double kSettlingTime = 0.3;  // [s]
constexpr double kDropSpeed = 1;       // for the stiffness [m/s]
constexpr double kDropOverlap = 0.02;  // [-]
constexpr int kAcross = 6;             // grains of a layer along x and along y
constexpr double kPitch = 1.3 * kGrainSize;
constexpr int kSettlingSteps[] = {5, 10, 20, 40};

enum class Detail { l_of_two, l_of_three, hull };

const char* name_of(Detail detail) {
  switch (detail) {
    case Detail::l_of_two:
      return "L of 2 parts";
    case Detail::l_of_three:
      return "L of 3 parts";
    case Detail::hull:
      return "hull of the L";
  }
  return "";
}

/// Prism over the L's convex hull, 1 high: the L with its inner corner filled.
dem_gpu::Shape l_hull() {
  const double h = 0.5;
  catalog::ConvexPart part;
  for (const double z : {-h, h})
    for (const auto& [x, y] : std::array<std::array<double, 2>, 5>{{{-1, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 1}}})
      part.vertices.push_back({x, y, z});
  const double slant = std::sqrt(0.5);
  part.faces = {{{4, 3, 2, 1, 0}, {{0, 0, -1}, h}, catalog::FaceKind::outer},
                {{5, 6, 7, 8, 9}, {{0, 0, 1}, h}, catalog::FaceKind::outer},
                {{0, 1, 6, 5}, {{0, -1, 0}, 1}, catalog::FaceKind::outer},
                {{1, 2, 7, 6}, {{1, 0, 0}, 1}, catalog::FaceKind::outer},
                {{2, 3, 8, 7}, {{slant, slant, 0}, slant}, catalog::FaceKind::outer},
                {{3, 4, 9, 8}, {{0, 1, 0}, 1}, catalog::FaceKind::outer},
                {{4, 0, 5, 9}, {{-1, 0, 0}, 1}, catalog::FaceKind::outer}};
  return dem_gpu::polyhedral_shape("hull", {part});
}

dem_gpu::Shape grain_shape(Detail detail) {
  if (detail == Detail::hull) return l_hull();
  const dem_gpu::Shape l = l_shape(detail == Detail::l_of_two ? 2 : 3);
  return dem_gpu::polyhedral_shape("L", std::get<dem_gpu::PolyhedralShape>(l.geometry).parts);
}

Scene settling_scene(const NamedLaw& law, Detail detail, std::uint64_t seed) {
  Scene scene;
  scene.name = "settling";
  scene.materials = {{"rock", 2700}};
  scene.contact = {{{0.4, 0.5}}};
  scene.shapes = {grain_shape(detail)};
  std::mt19937_64 random(seed);
  for (int i = 0; i < kGrains; ++i) {
    dem_gpu::Body body;
    body.scale = 0.4 * kGrainSize;
    const int layer = i / (kAcross * kAcross), cell = i % (kAcross * kAcross);
    body.position = {(cell % kAcross + 0.5) * kPitch, (cell / kAcross + 0.5) * kPitch, (layer + 0.7) * kPitch};
    body.orientation = random_rotation(random);
    body.velocity = {uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), -0.3};
    scene.bodies.push_back(body);
  }
  const double width = kAcross * kPitch;
  scene.walls = {plane_wall("floor", {}, {0, 0, 1}), plane_wall("left", {}, {1, 0, 0}),
                 plane_wall("right", {width, 0, 0}, {-1, 0, 0}), plane_wall("front", {}, {0, 1, 0}),
                 plane_wall("back", {0, width, 0}, {0, -1, 0})};
  set_law(scene, law, kDropSpeed, kDropOverlap);
  return scene;
}

struct Settled {
  double height = kFailedRun;     // mean of the centres, averaged over the last tenth of the time [m]
  double imbalance = kFailedRun;  // energy, over throughput
  double overlap = kFailedRun;    // largest, over the diameter
  double wall_time = kFailedRun;  // [s]
  std::string failure;
};

Settled settle(Scene scene, int steps_per_contact) {
  Settled settled;
  try {
    scene.run.steps_per_contact = steps_per_contact;
    Simulation simulation(scene);
    const auto steps = static_cast<std::int64_t>(std::ceil(kSettlingTime / simulation.time_step()));
    const WallClock clock;
    simulation.advance(steps - steps / 10);
    constexpr int kReadings = 5;
    double height = 0;
    for (int reading = 0; reading < kReadings; ++reading) {
      simulation.advance(steps / 10 / kReadings);
      for (const Vec3& position : simulation.snapshot().position) height += position.z;
    }
    settled.wall_time = clock.seconds();
    settled.height = height / (kReadings * kGrains);
    const dem_gpu::EnergyLedger ledger = simulation.ledger();
    settled.imbalance = std::abs(ledger.imbalance()) / ledger.throughput;
    settled.overlap = simulation.quality().largest_overlap;
  } catch (const std::exception& error) {
    settled.failure = error.what();
  }
  return settled;
}

/// The reference, made once whichever cases run.
const Settled& settling_reference() {
  static const Settled reference = settle(settling_scene(kDepth, Detail::l_of_two, 1), kFiner * kStandardSteps);
  return reference;
}

void add_settled(FigureList& figures, PlotCurve& curve, const Settled& run, const std::string& label) {
  const double error = std::abs(run.height / settling_reference().height - 1);
  figures.add("mean height, relative to the reference, " + label, error, "-", run.failure);
  figures.add("energy imbalance over throughput, " + label, run.imbalance, "-", run.failure);
  figures.add("largest overlap over diameter, " + label, run.overlap, "-", run.failure);
  figures.add("wall time, " + label, run.wall_time, "s", run.failure);
  curve.x.push_back(run.wall_time);
  curve.y.push_back(run.failure.empty() ? error : kFailedRun);
  curve.point_names.push_back(label);
}

}  // namespace

CaseResult measure_settling_steps(const NamedLaw& law) {
  CaseResult result;
  FigureList figures(result);
  PlotCurve curve{"settling", std::string(law.name) + ", by step", {}, {}, {}};
  for (const int steps : kSettlingSteps)
    add_settled(figures, curve, settle(settling_scene(law, Detail::l_of_two, 1), steps), steps_label(steps));
  result.curves = {curve};
  return result;
}

CaseResult measure_settling_detail() {
  CaseResult result;
  FigureList figures(result);
  PlotCurve curve{"settling", "depth, by level of detail", {}, {}, {}};
  for (const Detail detail : {Detail::hull, Detail::l_of_two, Detail::l_of_three})
    add_settled(figures, curve, settle(settling_scene(kDepth, detail, 1), kStandardSteps), name_of(detail));
  result.curves = {curve};
  return result;
}

CaseResult measure_settling_spread() {
  CaseResult result;
  FigureList figures(result);
  PlotCurve curve{"settling", "depth, other seeds", {}, {}, {}};
  for (const std::uint64_t seed : {2, 3, 4})
    add_settled(figures, curve, settle(settling_scene(kDepth, Detail::l_of_two, seed), kStandardSteps),
                "seed " + std::to_string(seed));
  result.curves = {curve};
  return result;
}

}  // namespace workflows
