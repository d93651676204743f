// SPDX-License-Identifier: Apache-2.0
// Levels of detail of a catalogue's shapes: error against what a contact of such bodies costs the engine.
#include <map>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/level_cost.h"
#include "workflows/level_choice.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

/// All levels of one shape, one mode, one cap of vertices and one of faces.
CaseResult measure_ladder(const fs::path& path, const catalog::ShapeSummary& shape, const std::vector<Level>& ladder) {
  const catalog::ShapeCatalog catalogue(path, catalog::ShapeCatalog::Access::read_only);
  CaseResult result;
  PlotCurve curve{"front", shape.name + ", " + ladder_text(ladder.front().key), {}, {}, {}};
  for (const Level& level : ladder) {
    const double cost = measured_contact_cost(catalogue.level(shape.id, level.key));
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
    plan.cases = {{"ladder", []() -> CaseResult {
                     throw catalog::UsageError("bench levels: no catalogue; add --catalog ore.talus");
                   }}};
    return plan;
  }
  const fs::path path = options.catalogue;
  const catalog::ShapeCatalog catalogue(path, catalog::ShapeCatalog::Access::read_only);
  for (const catalog::ShapeId id : catalogue.select("")) {
    const catalog::ShapeSummary shape = catalogue.summary(id);
    std::map<std::string, std::vector<Level>> ladders;
    for (const Level& level : shape.levels) ladders[ladder_name(level.key)].push_back(level);
    for (const auto& [name, ladder] : ladders)
      plan.cases.push_back(
          {shape.name + "-" + name, [path, shape, ladder = ladder] { return measure_ladder(path, shape, ladder); }});
  }
  if (plan.cases.empty())
    throw catalog::InputError(path.string() + ": has no levels of detail; make them with talus decompose");
  return plan;
}

}  // namespace workflows
