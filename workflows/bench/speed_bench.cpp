// SPDX-License-Identifier: Apache-2.0
// Speed on the scenes S1 to S4 (tests/benchmark/scenes), beside LIGGGHTS where it is installed.
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/speed/speed_cases.h"

namespace workflows {

using benchmark_scenes::Law;

BenchPlan plan_speed_bench(const BenchOptions&) {
  BenchPlan plan;
  const auto add = [&](const std::string& name, const std::string& scene, Law law, const SpeedGoal& goal) {
    plan.cases.push_back({name, [=] { return measure_speed(scene, law, goal); }});
  };
  add("s1-box", "s1-box", Law::depth_potential, {2.0});
  add("s1-drum", "s1-drum", Law::depth_potential, {2.6});
  add("s2-volume", "s2", Law::overlap_volume, {1.5});
  add("s2-depth", "s2", Law::depth_potential, {2.5});
  add("s3-volume", "s3", Law::overlap_volume, {1.5});
  add("s3-depth", "s3", Law::depth_potential, {2.5});
  add("s4-volume", "s4", Law::overlap_volume, {2.5});
  add("s4-depth", "s4", Law::depth_potential, {3.5});
  plan.cases.push_back({"s4-per-second", measure_simulated_second, {}, true});
  plan.plots = {{"steps", "Time of a step, one thread", "particles [-]", "time of a particle in a step [ns]"}};
  plan.page = speed_page;
  return plan;
}

}  // namespace workflows
