// SPDX-License-Identifier: Apache-2.0
#pragma once

// The bulk bench: wall time against error of whole scenes. What its scenes share, and the cases of each.

#include <cmath>
#include <string>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_plan.h"

namespace workflows {

/// Steps per contact of the default preset, where the goals stand.
inline constexpr int kStandardSteps = 20;

struct NamedLaw {
  const char* name;
  bool is_volume;
};
inline constexpr NamedLaw kDepth{"depth", false}, kVolume{"volume", true};

/// Gives the scene the law, its stiffness from the flat overlap: `flat_overlap` is that of the heaviest body's largest
/// flat face striking a wall at `speed` [m/s], over its diameter.
void set_law(dem_gpu::Scene& scene, const NamedLaw& law, double speed, double flat_overlap);

dem_gpu::Wall plane_wall(const std::string& name, const dem_gpu::Vec3& point, const dem_gpu::Vec3& normal);

std::string steps_label(int steps);

/// Figures of the runs of one scene: the value of each is left out, with the reason, where its run failed.
class FigureList {
 public:
  explicit FigureList(CaseResult& result) : result_(result) {}
  void add(const std::string& name, double value, const std::string& unit, const std::string& failure,
           std::optional<Goal> goal = {}) {
    Figure figure{name, value, unit, goal, failure};
    if (std::isnan(value)) figure.value.reset();
    result_.figures.push_back(figure);
  }

 private:
  CaseResult& result_;
};

/// A block thrown on a floor: it slides, tumbles, bounces. `parts_along`: cuts it into the cube of that many parts.
CaseResult measure_throw(const NamedLaw& law, int parts_along);

/// 500 Ls settling in a box: by step, at coarser shapes, and from other random attitudes (how far apart equal scenes
/// end is what an error of the settled height is to be held against).
CaseResult measure_settling_steps(const NamedLaw& law);
CaseResult measure_settling_detail();
CaseResult measure_settling_spread();

/// Power of a small drum with lifters.
CaseResult measure_drum(const NamedLaw& law);

}  // namespace workflows
