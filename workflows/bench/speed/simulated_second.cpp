// SPDX-License-Identifier: Apache-2.0
// What a simulated second of the mill S4 costs where overlaps keep a tolerance: the softest stiffness and the fewest
// steps in a contact that hold it, found by measurement.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/speed/settled_scene.h"
#include "workflows/bench/speed/speed_cases.h"
#include "workflows/bench/speed/step_time.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

using benchmark_scenes::Law;
using benchmark_scenes::SceneOptions;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr double kLargestOverlap = 0.04, kMeanOverlap = 0.002;  // over the diameter [-]
constexpr double kLargestEnergyError = 0.01;                    // of the preset draft
constexpr double kMostSeconds = 50;                             // CPU, of a simulated second
constexpr double kDiameter = 0.0124070;                         // of the sphere of a cube's volume [m]
constexpr int kSampleSteps = 50;                                // a corner's contact takes ten times as many
constexpr int kSamplesBefore = 10;                              // until what settled softer has come apart

struct Trial {
  double largest = 0, mean = 0;  // overlap over the diameter [-]
  double cpu_per_second = 0;     // [s]
  double energy_error = 0;       // over energy put in [-]; 0 without a ledger
};

/// Runs the settled mill for `time` [s].
Trial run_mill(const SceneOptions& options, double time) {
  Simulation simulation(scene_at(benchmark_scenes::speed_scene("s4"), Moment::settled, options));
  const int samples = std::max(20, static_cast<int>(time / simulation.time_step() / kSampleSteps));
  Trial trial;
  std::size_t contacts = 0;
  double spent = 0;
  for (int s = -kSamplesBefore; s < samples; ++s) {
    const CpuClock clock;
    simulation.advance(kSampleSteps);
    if (s < 0) continue;
    spent += clock.seconds();
    for (const auto& contact : simulation.snapshot().contacts) {
      trial.largest = std::max(trial.largest, contact.overlap / kDiameter);
      trial.mean += contact.overlap / kDiameter;
      ++contacts;
    }
  }
  trial.mean /= std::max<std::size_t>(contacts, 1);
  trial.cpu_per_second = spent / (samples * kSampleSteps * simulation.time_step());
  const dem_gpu::EnergyLedger ledger = simulation.ledger();
  if (ledger.throughput > 0) trial.energy_error = std::abs(ledger.imbalance()) / ledger.throughput;
  return trial;
}

SceneOptions softness(Law law, double flat_overlap, double steps_per_contact) {
  SceneOptions options;
  options.law = law;
  options.flat_overlap = flat_overlap;
  options.steps_per_contact = steps_per_contact;
  return options;
}

/// Fewest steps in the stiffest contact at which the energy still balances.
double fewest_steps(Law law) {
  constexpr double kTried[] = {5, 7, 10, 14, 20};
  for (const double steps : kTried) {
    SceneOptions options = softness(law, 0.02, steps);
    options.has_ledger = true;
    if (run_mill(options, 0.03).energy_error <= kLargestEnergyError) return steps;
  }
  return kTried[4];
}

/// Flat overlap at which both bounds hold: overlaps go with a power of it, taken from two softer runs, which are quick.
double softest(Law law, double steps) {
  constexpr double kSoft = 0.04, kHarder = 0.01, kTime = 0.07;  // half a lifter passage
  const Trial soft = run_mill(softness(law, kSoft, steps), kTime),
              harder = run_mill(softness(law, kHarder, steps), kTime);
  const auto reach = [&](double at_soft, double at_harder, double bound) {
    const double power = std::max(0.1, std::log(at_soft / at_harder) / std::log(kSoft / kHarder));
    return kHarder * std::pow(bound / at_harder, 1 / power);
  };
  return std::min(reach(soft.largest, harder.largest, kLargestOverlap), reach(soft.mean, harder.mean, kMeanOverlap));
}

void add_law(CaseResult& result, Law law, const std::string& name, std::optional<Goal> goal) {
  const double steps = fewest_steps(law), flat = softest(law, steps);
  const Trial trial = run_mill(softness(law, flat, steps), 0.02);
  const auto add = [&](const std::string& what, double value, const std::string& unit, std::optional<Goal> bound = {}) {
    result.figures.push_back({name + ": " + what, value, unit, bound, ""});
  };
  add("CPU time of a simulated second", trial.cpu_per_second, "s", goal);
  add("steps in the stiffest contact", steps, "-");
  add("flat overlap that sets the stiffness", flat, "-");
  add("largest overlap over diameter", trial.largest, "-", at_most(kLargestOverlap));
  add("mean overlap over diameter", trial.mean, "-", at_most(kMeanOverlap));
}

}  // namespace

CaseResult measure_simulated_second() {
  if (has_two_threads()) set_thread_count(1);
  CaseResult result;
  add_law(result, Law::depth_potential, "depth potential", at_most(kMostSeconds));
  add_law(result, Law::overlap_volume, "overlap volume", {});
  return result;
}

}  // namespace workflows
