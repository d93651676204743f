// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "catalog/mass_properties.h"
#include "shape_pipeline/ct_stack.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/virtual_stack.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/digitize/digitize_cases.h"

namespace workflows {
namespace {

namespace sp = shape_pipeline;

constexpr double kCentreTolerance = 0.1, kVolumeTolerance = 0.25;  // of a match, over the diameter and the volume

struct Truth {
  catalog::Point centre;
  double volume, area;
  int matches = 0;
};

std::vector<Truth> truths_of(const sp::VirtualStack& stack) {
  std::vector<Truth> truths;
  for (const catalog::TriangleMesh& mesh : stack.truths) {
    const catalog::MassProperties mass = catalog::mass_properties(mesh);
    truths.push_back({mass.centroid, mass.volume, sp::surface_area(mesh)});
  }
  return truths;
}

/// The truth that a grain is; null if it is none.
Truth* match(const sp::StackGrain& grain, std::vector<Truth>& truths, double diameter) {
  for (Truth& truth : truths) {
    const double distance = std::hypot(grain.centre[0] - truth.centre[0], grain.centre[1] - truth.centre[1],
                                       grain.centre[2] - truth.centre[2]);
    const double error = grain.shape.mass_properties.volume / truth.volume - 1;
    if (distance < kCentreTolerance * diameter && std::abs(error) < kVolumeTolerance) return &truth;
  }
  return nullptr;
}

}  // namespace

CaseResult measure_stack(const StackCase& stack, const std::vector<catalog::TriangleMesh>& meshes) {
  sp::StackRecipe recipe;
  recipe.diameter = stack.diameter;
  recipe.grains = stack.grains;
  sp::VirtualStack made = sp::virtual_stack(meshes, recipe);
  std::vector<Truth> truths = truths_of(made);
  sp::StackOptions options;
  options.least_diameter = 0.5 * stack.diameter;
  int found = 0, matched = 0;
  double volume_error = 0, largest = 0, area_error = 0;
  const CpuClock clock;
  sp::digitize_stack(std::move(made.volume), stack.name, options, [&](sp::StackGrain&& grain) {
    ++found;
    Truth* const truth = grain.refusal.empty() ? match(grain, truths, stack.diameter * recipe.voxel) : nullptr;
    if (!truth) return;
    ++truth->matches;
    ++matched;
    const double error = std::abs(grain.shape.mass_properties.volume / truth->volume - 1);
    volume_error += error;
    largest = std::max(largest, error);
    area_error += sp::surface_area(grain.shape.mesh) / truth->area - 1;
  });
  const double seconds = clock.seconds();
  const auto once = std::count_if(truths.begin(), truths.end(), [](const Truth& truth) { return truth.matches == 1; });
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal = {}) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  const double share = static_cast<double>(once) / static_cast<double>(truths.size());
  add("recovered one to one", 100 * share, "%",
      stack.one_to_one > 0 ? std::optional(at_least(100 * stack.one_to_one)) : std::nullopt);
  add("grains found that are none", found - matched, "-");
  if (matched > 0) {
    add("volume error, mean", 100 * volume_error / matched, "%",
        stack.volume_error > 0 ? std::optional(at_most(100 * stack.volume_error)) : std::nullopt);
    add("volume error, largest", 100 * largest, "%");
    add("area error, mean with sign", 100 * area_error / matched, "%");
    result.curves.push_back({"stacks",
                             stack.name.substr(0, stack.name.find('-')),
                             {stack.diameter},
                             {100 * volume_error / matched},
                             {stack.name}});
  }
  add("CPU time", seconds, "s");
  return result;
}

CaseResult measure_rock_stack(const StackCase& stack) {
  return measure_stack(stack, sp::stack_grains(stack.grains - 1, sp::StackRecipe{}.seed));
}

}  // namespace workflows
