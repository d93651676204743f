// SPDX-License-Identifier: Apache-2.0
// Levels of detail of a catalogue's shapes: error against what a contact of such bodies costs the engine.
#include "catalog/input_error.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/catalogue_levels.h"
#include "workflows/bench/laws/laws_cases.h"

namespace workflows {
namespace {

const dem_gpu::PolyhedralLaw kLaw = dem_gpu::DepthPotential{1};

/// All levels of one shape and one vertex cap.
CaseResult measure_ladder(const ShapeLevels& levels, int cap) {
  const dem_gpu::Shape cube = box_shape({1, 1, 1});
  const double cube_time = time_per_pair(cube, cube, kLaw);
  CaseResult result;
  PlotCurve curve{"front", levels.shape.name + ", " + std::to_string(cap) + " vertices", {}, {}, {}};
  for (const Level& level : levels.shape.levels) {
    if (level.vertex_cap != cap) continue;
    const dem_gpu::Shape body = levels.unit_shape(level);
    const double cost = time_per_pair(body, body, kLaw) / cube_time;
    const std::string parts = std::to_string(level.parts_asked) + " parts: ";
    result.figures.push_back({parts + "symmetric difference", level.error.symmetric_difference, "-", {}, ""});
    result.figures.push_back({parts + "time of a contact over that of cubes", cost, "-", {}, ""});
    result.figures.push_back({parts + "contact_cost over that", contact_cost(level) / cost, "-", {}, ""});
    curve.x.push_back(cost);
    curve.y.push_back(level.error.symmetric_difference);
    curve.point_names.push_back(std::to_string(level.parts_asked));
  }
  result.curves.push_back(std::move(curve));
  return result;
}

}  // namespace

BenchPlan plan_levels_bench(const BenchOptions& options) {
  BenchPlan plan;
  plan.plots = {{"front", "Error of a level against the cost of a contact", "time of a contact [contacts of cubes]",
                 "symmetric difference [-]"}};
  if (options.catalogue.empty()) {
    plan.cases = {{"ladder", []() -> CaseResult {
                     throw catalog::UsageError("bench levels: no catalogue; add --catalog ore.talus");
                   }}};
    return plan;
  }
  for (const ShapeLevels& levels : levels_of_catalogue(options.catalogue))
    for (const int cap : levels.vertex_caps())
      plan.cases.push_back(
          {levels.shape.name + "-" + std::to_string(cap), [levels, cap] { return measure_ladder(levels, cap); }});
  return plan;
}

}  // namespace workflows
