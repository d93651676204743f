// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/parts/rock_bed.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "workflows/bench/bench_plan.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/dense_packing.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kGravity = 9.81;  // [m/s2]
constexpr double kRadian = std::numbers::pi / 180;
constexpr double kReading = 0.005;  // between two looks at a moving bed [s]

/// Scale of a shape of volume 1 whose sphere of the same volume has the diameter kRockDiameter.
double rock_scale() { return std::cbrt(std::numbers::pi / 6) * kRockDiameter; }

dem_gpu::Wall wall_of(const std::string& name, decltype(dem_gpu::Wall::geometry) geometry) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = std::move(geometry);
  wall.contact_class = "box";
  return wall;
}

/// The box without its floor.
Scene sides(const dem_gpu::Shape& shape, const BedSize& size) {
  const double length = size.length * kRockDiameter, width = size.width * kRockDiameter;
  Scene scene;
  scene.name = "rock bed";
  scene.materials = {{"rock", kBedDensity}};
  scene.contact = {{{kBedRestitution, kBedFriction}}};
  scene.shapes = {shape};
  scene.walls = {
      wall_of("left", dem_gpu::Plane{{}, {1, 0, 0}}), wall_of("right", dem_gpu::Plane{{length, 0, 0}, {-1, 0, 0}}),
      wall_of("front", dem_gpu::Plane{{}, {0, 1, 0}}), wall_of("back", dem_gpu::Plane{{0, width, 0}, {0, -1, 0}})};
  scene.run.steps_per_contact = kBedSteps;
  scene.run.preset = dem_gpu::Preset::draft;
  return scene;
}

/// To be called when the bodies are in.
void set_stiffness(Scene& scene) {
  scene.polyhedral_law = dem_gpu::DepthPotential{1};
  scene.polyhedral_law = dem_gpu::DepthPotential{dem_gpu::stiffness_for_overlap(scene, kPourSpeed, kPourOverlap)};
}

std::vector<dem_gpu::Body> rocks_above_floor(double reach, std::uint64_t seed, const BedSize& size) {
  const BoxRegion region{{0, 0, 0}, {size.length * kRockDiameter, size.width * kRockDiameter, 100 * kRockDiameter}};
  RandomStream places(seed);
  const std::vector<Point> centres =
      dense_packing(region, std::vector<double>(size.rocks, reach * kRockDiameter), {0, 0, 1}, places);
  std::mt19937_64 attitudes(seed);
  std::vector<dem_gpu::Body> bodies;
  for (const Point& centre : centres) {
    dem_gpu::Body body;
    body.scale = rock_scale();
    body.position = {centre[0], centre[1], centre[2]};
    body.orientation = random_rotation(attitudes);
    bodies.push_back(body);
  }
  return bodies;
}

std::int64_t steps_in(const Simulation& simulation, double time) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(time / simulation.time_step())));
}

/// Bodies as they stand, to begin another scene with.
std::vector<dem_gpu::Body> bodies_of(const Scene& scene, const dem_gpu::Snapshot& now) {
  std::vector<dem_gpu::Body> bodies = scene.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].position = now.position[i];
    bodies[i].orientation = now.orientation[i];
    bodies[i].velocity = now.velocity[i];
    bodies[i].angular_velocity = now.angular_velocity[i];
  }
  return bodies;
}

/// Mean place along the box's length, as the box lies [m].
double mean_along(const dem_gpu::Snapshot& now) {
  const Vec3 along = dem_gpu::rotate(now.wall_rotation[0], {1, 0, 0});
  double sum = 0;
  for (const Vec3& position : now.position) sum += dot(position, along);
  return sum / static_cast<double>(now.position.size());
}

}  // namespace

PouredBed pour_bed(const dem_gpu::Shape& shape, double reach, std::uint64_t seed, const BedSize& size) {
  Scene scene = sides(shape, size);
  scene.walls.push_back(wall_of("floor", dem_gpu::Plane{{}, {0, 0, 1}}));
  scene.bodies = rocks_above_floor(reach, seed, size);
  set_stiffness(scene);
  Simulation simulation(scene);
  const std::int64_t steps = steps_in(simulation, kPourTime), timed = std::max<std::int64_t>(1, steps / 10);
  simulation.advance(steps - timed);
  const CpuClock clock;
  simulation.advance(timed);
  PouredBed bed;
  bed.size = size;
  bed.step_time = clock.seconds() / static_cast<double>(timed);
  const dem_gpu::Snapshot now = simulation.snapshot();
  bed.bodies = bodies_of(scene, now);
  double height = 0;
  for (const Vec3& position : now.position) height += position.z / size.rocks;
  const double rock = std::numbers::pi / 6 * std::pow(kRockDiameter, 3);
  bed.packing_fraction = size.rocks * rock / (size.length * size.width * kRockDiameter * kRockDiameter * 2 * height);
  for (const dem_gpu::SnapshotContact& contact : now.contacts)
    bed.contacts += (contact.body_b >= 0 ? 2.0 : 1.0) / size.rocks;
  bed.largest_overlap = simulation.quality().largest_overlap;
  const dem_gpu::EnergyLedger ledger = simulation.ledger();
  bed.imbalance = ledger.imbalance() / ledger.throughput;
  return bed;
}

double slide_angle(const dem_gpu::Shape& shape, const PouredBed& bed) {
  Scene scene = sides(shape, bed.size);
  scene.walls.push_back(wall_of("floor", dem_gpu::Plane{{}, {0, 0, 1}}));
  scene.gravity = kGravity * Vec3{std::sin(kFirstTilt * kRadian), 0, -std::cos(kFirstTilt * kRadian)};
  for (dem_gpu::Wall& wall : scene.walls) wall.motion.angular_velocity = {0, kTiltRate * kRadian, 0};
  scene.bodies = bed.bodies;
  set_stiffness(scene);
  Simulation simulation(scene);
  const double start = mean_along(simulation.snapshot()), slid = kSlip * kRockDiameter;
  double before = 0;
  const std::int64_t reading = steps_in(simulation, kReading);
  while (simulation.time() < kTiltTime) {
    const double last = simulation.time();
    simulation.advance(reading);
    const double way = mean_along(simulation.snapshot()) - start;
    if (way >= slid) {
      const double share = (slid - before) / (way - before);
      return kFirstTilt + kTiltRate * (last + share * (simulation.time() - last));
    }
    before = way;
  }
  return kFailedRun;
}

EmptiedBed empty_bed(const dem_gpu::Shape& shape, const PouredBed& bed) {
  Scene scene = sides(shape, bed.size);
  const double shelf = (1 - kOutlet) * bed.size.length * kRockDiameter, width = bed.size.width * kRockDiameter;
  scene.walls.push_back(
      wall_of("shelf", dem_gpu::VolumeObject{shifted(dem_gpu::box_part({2 * shelf, 2 * width, kRockDiameter}),
                                                     {0, width / 2, -kRockDiameter / 2})}));
  scene.outflow = dem_gpu::Outflow{{0, 0, 1}, -1.5 * kRockDiameter};
  scene.bodies = bed.bodies;
  set_stiffness(scene);
  Simulation simulation(scene);
  EmptiedBed emptied{kFailedRun, 1};
  const double half = bed.size.rocks / 2.0;
  int before = 0;
  const std::int64_t reading = steps_in(simulation, kReading);
  while (simulation.time() < kEmptyTime) {
    const double last = simulation.time();
    simulation.advance(reading);
    const int gone = simulation.bulk().removed_bodies;
    if (before < half && gone >= half)
      emptied.half_time = last + (half - before) / (gone - before) * (simulation.time() - last);
    before = gone;
  }
  emptied.left = 1 - static_cast<double>(before) / bed.size.rocks;
  return emptied;
}

}  // namespace workflows
