// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;

constexpr int kGrains = 300;
constexpr double kSize = 0.01;            // about a grain's diameter [m]
constexpr double kSettlingTime = 0.15;    // [s]
constexpr double kImpactSpeed = 1;        // of a fall through the lattice [m/s]
constexpr double kFlatOverlap = 0.02;     // of a flat face on a wall at that speed, over its diameter [-]
constexpr double kSphereStiffness = 3e4;  // 2 % of the diameter at that speed, as the flat faces [N/m]
constexpr int kWindows = 5;               // of the last part of the run, for the time per step

void add_wall(Scene& scene, const std::string& name, const Vec3& point, const Vec3& normal) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::Plane{point, normal};
  wall.contact_class = "box";
  scene.walls.push_back(wall);
}

/// Boxes, Ls of two parts and spheres in turn, at random attitudes on a lattice above the floor of an open box.
Scene pile_scene() {
  Scene scene;
  scene.name = "pile";
  scene.materials = {{"rock", 2700}};
  scene.contact = {{{0.5, 0.5}}};
  const dem_gpu::Shape l = l_shape(2);  // 2 x 2 x 1
  scene.shapes = {dem_gpu::polyhedral_shape("box", {dem_gpu::box_part({kSize, 0.8 * kSize, 0.6 * kSize})}),
                  dem_gpu::polyhedral_shape("L", std::get<dem_gpu::PolyhedralShape>(l.geometry).parts),
                  dem_gpu::sphere_shape("sphere", 0.4 * kSize)};
  constexpr int kAcross = 6;
  const double pitch = 1.45 * kSize;  // more than the diagonal of the boxes
  std::mt19937_64 random(300);
  for (int i = 0; i < kGrains; ++i) {
    dem_gpu::Body body;
    body.shape = i % 3;
    body.scale = body.shape == 1 ? 0.4 * kSize : 1;
    const int layer = i / (kAcross * kAcross), cell = i % (kAcross * kAcross);
    body.position = {(cell % kAcross + 0.5) * pitch, (cell / kAcross + 0.5) * pitch, (layer + 0.6) * pitch};
    body.orientation = random_rotation(random);
    body.velocity = {uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), -0.3};
    scene.bodies.push_back(body);
  }
  const double width = kAcross * pitch;
  add_wall(scene, "floor", {}, {0, 0, 1});
  add_wall(scene, "left", {}, {1, 0, 0});
  add_wall(scene, "right", {width, 0, 0}, {-1, 0, 0});
  add_wall(scene, "front", {}, {0, 1, 0});
  add_wall(scene, "back", {0, width, 0}, {0, -1, 0});
  scene.polyhedral_law = dem_gpu::DepthPotential{dem_gpu::stiffness_for_overlap(scene, kImpactSpeed, kFlatOverlap)};
  scene.sphere_law = dem_gpu::LinearSpring{kSphereStiffness};
  scene.run.end_time = kSettlingTime;
  return scene;
}

struct PileRun {
  double ms_per_step = 0;  // median of the last windows
  double ms_least = 0, ms_largest = 0;
  double seconds = 0;
  std::int64_t steps = 0;
  dem_gpu::BulkState bulk;
  dem_gpu::EnergyLedger ledger;
  dem_gpu::RunQuality quality;
  dem_gpu::Snapshot end;
};

PileRun run_pile(const Scene& scene) {
  dem_gpu::Simulation simulation(scene);
  PileRun run;
  run.steps = static_cast<std::int64_t>(std::ceil(kSettlingTime / simulation.time_step()));
  const WallClock whole;
  const std::int64_t window = run.steps / (4 * kWindows);
  simulation.advance(run.steps - kWindows * window);
  std::vector<double> times;
  for (int i = 0; i < kWindows; ++i) {
    const WallClock clock;
    simulation.advance(window);
    times.push_back(1e3 * clock.seconds() / static_cast<double>(window));
  }
  run.seconds = whole.seconds();
  std::sort(times.begin(), times.end());
  run.ms_per_step = times[kWindows / 2];
  run.ms_least = times.front();
  run.ms_largest = times.back();
  run.bulk = simulation.bulk();
  run.ledger = simulation.ledger();
  run.quality = simulation.quality();
  run.end = simulation.snapshot();
  return run;
}

/// Number of bodies whose position differs in any bit.
int bodies_that_differ(const dem_gpu::Snapshot& a, const dem_gpu::Snapshot& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    count += std::memcmp(&a.position[i], &b.position[i], sizeof(Vec3)) != 0;
  return count;
}

void add_speed(CaseResult& result, const PileRun& run, const std::string& at) {
  const auto add = [&](const std::string& name, double value, const std::string& unit) {
    result.figures.push_back({name + at, value, unit, {}, ""});
  };
  add("time a step, median of the last windows", run.ms_per_step, "ms");
  add("time a step, fastest window", run.ms_least, "ms");
  add("time a step, slowest window", run.ms_largest, "ms");
  add("particle-steps per second", 1e3 * kGrains / run.ms_per_step, "1/s");
  add("wall time of the run", run.seconds, "s");
}

CaseResult measure_pile(const std::vector<int>& threads) {
  const Scene scene = pile_scene();
  CaseResult result;
  std::vector<PileRun> runs;
  for (const int count : threads) {
    set_thread_count(count);
    runs.push_back(run_pile(scene));
    add_speed(result, runs.back(), ", " + std::to_string(count) + (count == 1 ? " thread" : " threads"));
  }
  if (runs.empty()) {
    runs.push_back(run_pile(scene));
    add_speed(result, runs.back(), "");
  }
  const PileRun& run = runs.front();
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  add("steps", static_cast<double>(run.steps), "-", {});
  add("contacts at the end", run.bulk.contacts, "-", {});
  add("contacts per grain at the end", 2.0 * run.bulk.contacts / kGrains, "-", {});
  add("energy imbalance over energy put in", std::abs(run.ledger.imbalance()) / run.ledger.throughput, "-",
      at_most(0.02));
  add("largest overlap over equivalent diameter", run.quality.largest_overlap, "-", {});
  add("fewest steps in a contact", run.quality.smallest_steps_per_contact, "-", {});
  add("neighbour list rebuilds", static_cast<double>(run.quality.list_rebuilds), "-", {});
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const std::string pair = std::to_string(threads[i]) + " against " + std::to_string(threads[0]);
    add("speed ratio, threads " + pair, runs[0].ms_per_step / runs[i].ms_per_step, "-", {});
    add("bodies that end elsewhere, threads " + pair, bodies_that_differ(runs[0].end, runs[i].end), "-", at_most(0));
  }
  return result;
}

}  // namespace

BenchPlan plan_pile_bench(const BenchOptions& options) {
  return {{{"settling", [threads = options.threads] { return measure_pile(threads); }}}, {}};
}

}  // namespace workflows
