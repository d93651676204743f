// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_promises.h"

#include <algorithm>
#include <cmath>

#include "workflows/text_format.h"

namespace workflows {

using dem_gpu::Scene;

namespace {

constexpr const char* kFinerStep = "a finer preset (or a shorter time step)";

/// What would keep the broken promises, each remedy once; empty if all are kept.
std::string remedies(const std::vector<PromiseKept>& all) {
  std::vector<std::string> named;
  for (const PromiseKept& one : all)
    if (!one.is_kept && std::find(named.begin(), named.end(), one.remedy) == named.end()) named.push_back(one.remedy);
  std::string text;
  for (const std::string& remedy : named) text += (text.empty() ? "" : " and ") + remedy;
  return text;
}

}  // namespace

double imbalance_share(const dem_gpu::EnergyLedger& ledger) {
  return ledger.throughput > 0 ? std::abs(ledger.imbalance()) / ledger.throughput : 0;
}

std::vector<PromiseKept> promises(const AssembledScene& assembled, const dem_gpu::Simulation& simulation,
                                  const dem_gpu::EnergyLedger& ledger) {
  const dem_gpu::Promise promise = dem_gpu::promise_of(assembled.scene.run.preset);
  const dem_gpu::RunQuality quality = simulation.quality();
  std::vector<PromiseKept> all;
  if (assembled.scene.energy_ledger)
    all.push_back({"energy imbalance, share of the energy put in", imbalance_share(ledger), promise.energy_imbalance,
                   imbalance_share(ledger) <= promise.energy_imbalance, kFinerStep});
  all.push_back({"largest overlap, share of the diameter", quality.largest_overlap, promise.largest_overlap,
                 quality.largest_overlap <= promise.largest_overlap, "stiffer contacts (a higher at_speed)"});
  if (quality.smallest_steps_per_contact > 0)
    all.push_back({"fewest steps in a contact", quality.smallest_steps_per_contact, promise.steps_per_contact,
                   quality.smallest_steps_per_contact >= promise.steps_per_contact, kFinerStep});
  return all;
}

std::string promise_line(const AssembledScene& assembled, const std::vector<PromiseKept>& kept) {
  std::string line = formatted("preset \"%s\"", dem_gpu::promise_of(assembled.scene.run.preset).name);
  const char* before = ": ";
  for (const PromiseKept& one : kept) {
    line += formatted("%s%s %.3g (promised %.3g, %s)", before, one.figure.c_str(), one.value, one.promised,
                      one.is_kept ? "kept" : "broken");
    before = "; ";
  }
  return line;
}

std::optional<std::string> start_warning(const Scene& scene) {
  const dem_gpu::Promise promise = dem_gpu::promise_of(scene.run.preset);
  const double shortest = dem_gpu::shortest_contact_time(scene), steps = shortest / dem_gpu::time_step(scene);
  // Rounding of a step stated to four digits breaks no promise.
  constexpr double kRounding = 1e-3;
  if (steps >= (1 - kRounding) * promise.steps_per_contact) return std::nullopt;
  return formatted(
      "a time step of %.4g us gives the shortest contact (%.4g us) %.3g steps, not the %.3g that preset \"%s\" "
      "promises its accuracy for; use at most %.4g us",
      1e6 * dem_gpu::time_step(scene), 1e6 * shortest, steps, promise.steps_per_contact, promise.name,
      1e6 * shortest / promise.steps_per_contact);
}

std::vector<std::string> run_warnings(const AssembledScene& assembled, const SceneDescription& description,
                                      const dem_gpu::Simulation& simulation, const dem_gpu::EnergyLedger& ledger) {
  std::vector<std::string> warnings;
  const dem_gpu::RunQuality quality = simulation.quality();
  if (const auto warning = start_warning(assembled.scene)) warnings.push_back(*warning);
  const std::vector<PromiseKept> kept = promises(assembled, simulation, ledger);
  if (const std::string remedy = remedies(kept); !remedy.empty())
    warnings.push_back(promise_line(assembled, kept) + "; the remedy: " + remedy);
  if (description.stiffness.largest_overlap && quality.largest_overlap > *description.stiffness.largest_overlap)
    warnings.push_back(
        formatted("the largest overlap was %.4g %% of a body's diameter; the %.4g %% asked for hold at "
                  "at_speed, for polyhedra in a flat strike; state a higher at_speed for stiffer grains",
                  100 * quality.largest_overlap, 100 * *description.stiffness.largest_overlap));
  return warnings;
}

}  // namespace workflows
