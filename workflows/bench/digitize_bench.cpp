// SPDX-License-Identifier: GPL-3.0-or-later
// Digitising: what each way from a scan to a shape loses, against truths.
#include <filesystem>
#include <memory>
#include <utility>

#include "catalog/input_error.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/decomposition/solids.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

/// Of these, as scanned, stacks are made.
const std::vector<std::string> kStackSolids{"stone10", "stone14", "ashlar_1050", "itokawa"};

}  // namespace

BenchPlan plan_digitize_bench(const BenchOptions& options) {
  BenchPlan plan;
  plan.cases.push_back({"descriptors-exact", measure_exact_descriptors});
  plan.cases.push_back({"descriptors-scanners", measure_scanner_spread});
  for (const StackCase& stack : kStackCases)
    plan.cases.push_back({"stack-" + stack.name, [stack] { return measure_rock_stack(stack); }});
  const auto solids = std::make_shared<BenchSolids>(options.scans);
  std::vector<std::string> present;
  for (const std::string& name : kStackSolids)
    if (solids->has(name)) present.push_back(name);
  if (!present.empty())
    for (const StackCase& stack : kScanStackCases)
      plan.cases.push_back({"stack-" + stack.name, [solids, present, stack] {
                              std::vector<catalog::TriangleMesh> meshes;
                              for (const std::string& name : present) meshes.push_back(solids->mesh(name));
                              return measure_stack(stack, meshes);
                            }});
  for (const RegistrationCase& parts : kRegistrationCases)
    plan.cases.push_back({"registration-" + parts.name, [parts] { return measure_registration(parts); }});
  plan.cases.push_back({"registration-strangers", measure_strangers});
  plan.cases.push_back({"plate", measure_plate});
  if (std::filesystem::exists(options.scans / kCaptureFiles[0]) &&
      std::filesystem::exists(options.scans / kCaptureFiles[1]))
    plan.cases.push_back({"captures", [scans = options.scans] { return measure_captures(scans); }});
  for (const TurntableCase& turntable : kTurntableCases)
    plan.cases.push_back({turntable.name, [solids, turntable] {
                            auto measured = turntable_rocks();
                            if (solids->has("stone10")) measured.emplace_back("stone10", solids->mesh("stone10"));
                            return measure_turntable(turntable, measured);
                          }});
  if (std::filesystem::exists(options.scans / kPopulationFile))
    plan.cases.push_back({"population", [scans = options.scans] { return measure_population(scans); }});
  for (const CloudPair& pair : kCloudPairs)
    if (std::filesystem::exists(options.scans / pair.cloud) && std::filesystem::exists(options.scans / pair.mesh))
      plan.cases.push_back(
          {"cloud-" + pair.name, [scans = options.scans, pair] { return measure_cloud(scans, pair); }});
  if (std::filesystem::exists(options.scans / kHandOutlines))
    for (BenchCase& micrograph : plan_micrographs_bench(options).cases)
      plan.cases.push_back({"micrograph-" + micrograph.name, std::move(micrograph.measure)});
  plan.plots = {{"stacks", "Volume error of grains of a tomogram", "voxels a diameter", "mean volume error [%]"}};
  return plan;
}

}  // namespace workflows
