// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

/// Over the equivalent diameter.
constexpr double kCaps[] = {0.02, 0.05, 0.1, 0.15, 0.25, 0.5};

/// Two cubes of edge 1 m, face to face, one driven through the other up to their common centre.
struct Press {
  std::vector<double> depth, force;  // over the edge [-], [N]
  double barrier = 0;                // energy to the centre over that at 1 % of the edge
};

Press press(const dem_gpu::DepthPotential& law) {
  const dem_gpu::Shape cube = box_shape({1, 1, 1});
  const dem_gpu::OverlapProbe probe(cube, cube, law);
  constexpr int kDepths = 2000, kOnePercent = kDepths / 100;
  Press result;
  double energy = 0, first_energy = 0, last_force = 0;
  for (int i = 1; i <= kDepths; ++i) {
    const double depth = static_cast<double>(i) / kDepths;
    const double force = norm(probe.contact({{}, {{0, 0, 1 - depth}}}).force);
    energy += (force + last_force) / (2 * kDepths);
    last_force = force;
    if (i == kOnePercent) first_energy = energy;
    result.depth.push_back(depth);
    result.force.push_back(force);
  }
  result.barrier = energy / first_energy;
  return result;
}

/// Depth from which `capped` is over 1 % below `free` [edge].
double felt_from(const Press& capped, const Press& free) {
  for (std::size_t i = 0; i < free.force.size(); ++i)
    if (capped.force[i] < 0.99 * free.force[i]) return free.depth[i];
  return 1;
}

/// Every `stride`-th point, so that the plot stays light.
PlotCurve curve_of(const Press& pressed, const std::string& label, std::size_t stride) {
  PlotCurve curve{"press", label, {}, {}, {}};
  for (std::size_t i = stride - 1; i < pressed.depth.size(); i += stride) {
    curve.x.push_back(pressed.depth[i]);
    curve.y.push_back(pressed.force[i]);
    curve.point_names.push_back("depth " + std::to_string(pressed.depth[i]));
  }
  return curve;
}

CaseResult measure_cap(double cap) {
  dem_gpu::DepthPotential law{0.5}, no_cap{0.5};
  law.depth_cap = cap;
  no_cap.depth_cap = 1;  // deeper than any point of a body
  const Press pressed = press(law);
  const dem_gpu::Shape cube = box_shape({1, 1, 1}), rock = rough_rock_shape();
  char label[32];
  std::snprintf(label, sizeof label, "cap %g", cap);
  return {{{"felt from this depth on, flat cubes", felt_from(pressed, press(no_cap)), "edge", {}, ""},
           {"energy to press cubes to one centre, over that at 1 %", pressed.barrier, "-", {}, ""},
           {"rock on cross, net work over the swing of energy", rough_path_work(law).share, "-", at_most(1e-5), ""},
           {"time a pair of cubes", 1e9 * time_per_pair(cube, cube, law), "ns", {}, ""},
           {"time a pair of rocks", 1e9 * time_per_pair(rock, rock, law), "ns", {}, ""}},
          {curve_of(pressed, label, 50)}};
}

}  // namespace

void add_cap_cases(BenchPlan& plan) {
  for (const double cap : kCaps) {
    char name[32];
    std::snprintf(name, sizeof name, "cap-%g", cap);
    plan.cases.push_back({name, [cap] { return measure_cap(cap); }});
  }
}

}  // namespace workflows
