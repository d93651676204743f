// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {

using dem_gpu::DepthPotential;
using dem_gpu::HardeningDepthPotential;
using dem_gpu::OverlapVolume;

const std::vector<NamedLaw>& compared_laws() {
  // Flat on flat, F = 2 k A d for the depth potential and k A d for the volume law: equal stiffness at these constants.
  // The hardening law is twice as stiff at 1 % of a cube's edge.
  static const double cube_diameter = std::cbrt(6 / std::numbers::pi);
  static const std::vector<NamedLaw> laws{
      {"depth", DepthPotential{0.5}, true},
      {"hardening", HardeningDepthPotential{DepthPotential{0.5}, 0.01 / cube_diameter}, true},
      {"volume", OverlapVolume{1}, false}};
  return laws;
}

std::optional<Goal> goal_for(const NamedLaw& law, Goal goal) {
  return law.is_gradient ? std::optional<Goal>(goal) : std::nullopt;
}

dem_gpu::Quaternion turned(const dem_gpu::Vec3& axis, double degrees) {
  return dem_gpu::axis_angle(axis, degrees * std::numbers::pi / 180);
}

BenchPlan plan_laws_bench(const BenchOptions&) {
  BenchPlan plan;
  for (const NamedLaw& law : compared_laws()) {
    add_path_cases(plan, law);
    add_cut_cases(plan, law);
    add_stiffness_cases(plan, law);
    add_cost_cases(plan, law);
  }
  add_cap_cases(plan);
  plan.plots = {{"force", "Cube of edge 1 m on a wide block, flat stiffness 1 N/m3", "depth [m]", "force [N]"},
                {"press", "A cube pressed through its like, by depth cap", "depth over edge [-]", "force [N]"}};
  return plan;
}

}  // namespace workflows
