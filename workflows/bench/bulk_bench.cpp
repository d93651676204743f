// SPDX-License-Identifier: Apache-2.0
// Wall time against error of whole scenes: a thrown block, grains that settle, a drum that turns.
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bulk/bulk_cases.h"

namespace workflows {

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
