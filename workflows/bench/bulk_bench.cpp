// SPDX-License-Identifier: Apache-2.0
// Wall time against error of whole scenes: a thrown block, grains that settle, a drum that turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

/// Steps per contact of the default preset, where the goals stand.
constexpr int kStandardSteps = 20;
constexpr int kFiner = 16;  // the reference of the chaotic scenes, against the standard step

struct NamedLaw {
  const char* name;
  bool is_volume;
};
constexpr NamedLaw kDepth{"depth", false}, kVolume{"volume", true};

/// `flat_overlap`: of the heaviest body's largest flat face striking a wall at `speed`, over its diameter.
void set_law(Scene& scene, const NamedLaw& law, double speed, double flat_overlap) {
  if (law.is_volume)
    scene.polyhedral_law = dem_gpu::OverlapVolume{1};
  else
    scene.polyhedral_law = dem_gpu::DepthPotential{1};
  const double stiffness = dem_gpu::stiffness_for_overlap(scene, speed, flat_overlap);
  std::visit([&](auto& chosen) { chosen.stiffness = stiffness; }, scene.polyhedral_law);
}

dem_gpu::Wall plane_wall(const std::string& name, const Vec3& point, const Vec3& normal) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::Plane{point, normal};
  return wall;
}

std::string steps_label(int steps) { return std::to_string(steps) + " steps"; }

/// Figures of the runs of one scene: the value of each is left out, with the reason, where its run failed.
class FigureList {
 public:
  explicit FigureList(CaseResult& result) : result_(result) {}
  void add(const std::string& name, double value, const std::string& unit, const std::string& failure,
           std::optional<Goal> goal = {}) {
    Figure figure{name, value, unit, goal, failure};
    if (std::isnan(value)) figure.value.reset();
    result_.figures.push_back(figure);
  }

 private:
  CaseResult& result_;
};

// --- A block thrown on a floor: it slides, tumbles, bounces.

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
  catalog::ConvexPart slab = dem_gpu::box_part({1, 1, 0.1});
  for (catalog::Point& vertex : slab.vertices) vertex[2] -= 0.05;
  for (catalog::ConvexFace& face : slab.faces) face.plane.offset -= 0.05 * face.plane.normal[2];
  floor.geometry = dem_gpu::VolumeObject{slab};
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

// --- 500 Ls settling in a box; the same at coarser shapes.

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

/// How far apart equal scenes with other random attitudes end: what an error of the settled height is to be held
/// against.
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

// --- Power of a small drum with lifters.

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

}  // namespace

BenchPlan plan_bulk_bench(const BenchOptions&) {
  BenchPlan plan;
  for (const NamedLaw law : {kDepth, kVolume})
    for (const int parts_along : {1, 2})
      plan.cases.push_back({std::string("throw-") + law.name + (parts_along > 1 ? "-8-parts" : ""),
                            [law, parts_along] { return measure_throw(law, parts_along); }});
  for (const NamedLaw law : {kDepth, kVolume})
    plan.cases.push_back({std::string("settling-") + law.name, [law] { return measure_settling_steps(law); }});
  plan.cases.push_back({"settling-detail", measure_settling_detail});
  plan.cases.push_back({"settling-spread", measure_settling_spread});
  for (const NamedLaw law : {kDepth, kVolume})
    plan.cases.push_back({std::string("drum-") + law.name, [law] { return measure_drum(law); }});
  const std::string time = "wall time [s]";
  plan.plots = {
      {"throw", "A thrown block, 5 to 80 steps in the stiffest contact, against 640", time,
       "largest distance of the paths over size [-]"},
      {"settling", "500 grains settling, against 320 steps in the stiffest contact", time,
       "error of the mean height [-]"},
      {"drum", "Power of a small drum, against 80 steps in the stiffest contact", time, "error of the mean power [-]"}};
  return plan;
}

}  // namespace workflows
