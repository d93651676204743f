// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/growth/beds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/speed/step_time.h"

namespace workflows {
namespace {

using benchmark_scenes::SceneOptions;
using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kRise = 3e-5;  // of a bed in a step [m]
constexpr int kWarmUp = 5;
/// Few and always as many, since a bed that rises slackens.
constexpr int kSteps = 20;
constexpr double kParticleSteps = 1e6;  // to be timed, in as many runs as it takes
constexpr int kMostRuns = 20;

Scene settled_box(const std::string& scene, const SceneOptions& options) {
  static std::map<std::string, dem_gpu::Snapshot> known;
  const benchmark_scenes::SpeedScene& chosen = benchmark_scenes::speed_scene(scene);
  const auto found = known.find(scene);
  const dem_gpu::Snapshot& snapshot =
      found != known.end()
          ? found->second
          : known.emplace(scene, benchmark_scenes::settle(chosen, options.bodies).settled).first->second;
  return benchmark_scenes::resumed(chosen.make(options), snapshot);
}

/// Between the planes left and right.
double width_of(const Scene& scene) {
  double width = 0;
  for (const dem_gpu::Wall& wall : scene.walls)
    if (const auto* plane = std::get_if<dem_gpu::Plane>(&wall.geometry)) width = std::max(width, plane->point.x);
  return width;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Times of single steps, those in which bodies were listed anew apart [ms].
struct StepSamples {
  std::vector<double> plain, listing;
  void add(Simulation& simulation, int steps) {
    for (int i = 0; i < steps; ++i) {
      const std::int64_t lists = simulation.quality().list_rebuilds;
      const double time = time_steps(simulation, 1, 1).median;
      (simulation.quality().list_rebuilds == lists ? plain : listing).push_back(time);
    }
  }
};

}  // namespace

int bodies_of_a_box(const std::string& scene) { return scene == "s1-box" ? 2500 : 250; }

Scene bed(const BedOptions& options) {
  SceneOptions of_box;
  of_box.law = options.law;
  of_box.bodies = bodies_of_a_box(options.scene);
  const Scene box = settled_box(options.scene, of_box);
  SceneOptions of_whole = of_box;
  of_whole.bodies *= options.across * options.across;
  Scene whole = benchmark_scenes::speed_scene(options.scene).make(of_whole);
  whole.run = box.run;
  whole.bodies.clear();
  for (int row = 0; row < options.across; ++row)
    for (int column = 0; column < options.across; ++column)
      for (dem_gpu::Body body : box.bodies) {
        body.position += width_of(box) * Vec3{static_cast<double>(column), static_cast<double>(row), 0};
        body.velocity = body.angular_velocity = Vec3{};
        whole.bodies.push_back(body);
      }
  return whole;
}

BedCost cost_of(Scene bed) {
  const double rise = kRise / dem_gpu::time_step(bed);
  for (dem_gpu::Body& body : bed.bodies) body.velocity.z += rise;
  const auto bodies = static_cast<double>(bed.bodies.size());
  const int runs = std::clamp(static_cast<int>(kParticleSteps / (bodies * kSteps)), 1, kMostRuns);
  StepSamples samples;
  BedCost cost;
  for (int run = 0; run < runs; ++run) {
    const std::size_t before = allocated_bytes();
    Simulation simulation(bed);
    simulation.advance(kWarmUp);
    samples.add(simulation, kSteps);
    cost.memory = static_cast<double>(allocated_bytes() - before) / bodies;
    cost.contacts = 0;
    for (const auto& contact : simulation.snapshot().contacts) cost.contacts += (contact.body_b >= 0 ? 2 : 1) / bodies;
  }
  cost.step_time = 1e6 * median(samples.plain) / bodies;
  cost.listing_time = std::max(0.0, 1e6 * median(samples.listing) / bodies - cost.step_time);
  return cost;
}

}  // namespace workflows
