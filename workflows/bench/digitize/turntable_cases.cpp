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
constexpr double kLargestExcess = 1;  // [%] over the best hull

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
    recipe.side = 384;
    recipe.axis_offset = 3.3;
    sp::TurntableViews views = sp::virtual_turntable(mesh, recipe);
    const CpuClock clock;
    const catalog::ShapeRecord shape = sp::digitize_turntable(std::move(views), turntable.name, {});
    seconds += clock.seconds();
    const double volume = shape.mass_properties.volume;
    add(name + ", volume over the best hull", 100 * (volume / sp::best_hull_volume(mesh, turntable.views, kSlices) - 1),
        "%", at_most(kLargestExcess));
    add(name + ", volume over the mesh", 100 * (volume / catalog::mass_properties(mesh).volume - 1), "%");
  }
  add("CPU time", seconds, "s");
  return result;
}

}  // namespace workflows
