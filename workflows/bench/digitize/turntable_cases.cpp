// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "catalog/mass_properties.h"
#include "shape_pipeline/virtual_scan.h"
#include "shape_pipeline/virtual_turntable.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

namespace sp = shape_pipeline;

constexpr int kSlices = 1000;        // of the best hull: twice as many change its volume by less than 1e-5
constexpr double kLargestError = 1;  // [%]; a hull that is smaller than the best is no better

catalog::TriangleMesh rock(std::uint64_t seed, double flatness, double notch_depth) {
  sp::RockRecipe recipe;
  recipe.seed = seed;
  recipe.flatness = flatness;
  recipe.notch_depth = notch_depth;
  recipe.subdivisions = 4;
  return sp::virtual_rock(recipe);
}

}  // namespace

std::vector<std::pair<std::string, catalog::TriangleMesh>> turntable_rocks() {
  return {{"rock", rock(1, 0.8, 0)}, {"notched rock", rock(2, 0.8, 0.35)}, {"flat rock", rock(3, 0.5, 0)}};
}

CaseResult measure_turntable(const TurntableCase& turntable,
                             const std::vector<std::pair<std::string, catalog::TriangleMesh>>& solids) {
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal = {}) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  double seconds = 0;
  for (const auto& [name, mesh] : solids) {
    sp::TurntableRecipe recipe;
    recipe.views = turntable.views;
    recipe.side = turntable.side;
    recipe.noise = turntable.noise;
    recipe.elevation = turntable.elevation;
    recipe.is_perspective = turntable.elevation != 0;
    recipe.axis_offset = 3.3;
    sp::TurntableViews views = sp::virtual_turntable(mesh, recipe);
    const CpuClock clock;
    const catalog::ShapeRecord shape = sp::digitize_turntable(std::move(views), turntable.name, {});
    seconds += clock.seconds();
    const double volume = shape.mass_properties.volume;
    if (!recipe.is_perspective) {
      const double error = volume / sp::best_hull_volume(mesh, turntable.views, kSlices) - 1;
      add(name + ", volume off the best hull, magnitude", 100 * std::abs(error), "%", at_most(kLargestError));
    }
    add(name + ", volume over the mesh", 100 * (volume / catalog::mass_properties(mesh).volume - 1), "%");
  }
  add("CPU time", seconds, "s");
  return result;
}

}  // namespace workflows
