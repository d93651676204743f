// SPDX-License-Identifier: Apache-2.0
// Levels of detail of a catalogue's shapes: error against what a contact of such bodies costs the engine.
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/catalogue_levels.h"
#include "workflows/bench/level_cost.h"

namespace workflows {
namespace {

CaseResult measure_ladder(const ShapeLevels& shape, const std::vector<Level>& ladder) {
  CaseResult result;
  PlotCurve curve{"front", shape.shape.name + ", " + ladder_text(ladder.front().key), {}, {}, {}};
  for (const Level& level : ladder) {
    const double cost = measured_contact_cost(shape.unit_shape(level));
    const std::string parts = std::to_string(level.key.parts_asked) + " parts: ";
    result.figures.push_back({parts + "symmetric difference", level.error.symmetric_difference, "-", {}, ""});
    result.figures.push_back({parts + "time of a contact over that of cubes", cost, "-", {}, ""});
    result.figures.push_back({parts + "contact_cost over that", contact_cost(level) / cost, "-", {}, ""});
    curve.x.push_back(cost);
    curve.y.push_back(level.error.symmetric_difference);
    curve.point_names.push_back(std::to_string(level.key.parts_asked));
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
    plan.lacks = "no catalogue; add --catalog ore.talus";
    plan.cases = {{"ladder", nullptr}};
    return plan;
  }
  for (const ShapeLevels& shape : levels_of_catalogue(options.catalogue))
    for (const auto& [name, ladder] : shape.ladders())
      plan.cases.push_back(
          {shape.shape.name + "-" + name, [shape, ladder = ladder] { return measure_ladder(shape, ladder); }});
  return plan;
}

}  // namespace workflows
