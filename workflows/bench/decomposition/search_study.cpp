// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/search_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace workflows {
namespace {

constexpr double kStandardErrors = 3;

double difference(const LevelRun& run) { return 100 * run.level.error.symmetric_difference; }

}  // namespace

std::string SearchStudy::figure(int of_parts, double setting, const std::string& what) const {
  char number[32];
  std::snprintf(number, sizeof number, "%g", setting);
  return level(of_parts) + ", " + name + " " + number + unit + ": " + what;
}

Setback setback(const std::vector<std::vector<LevelRun>>& before, const std::vector<LevelRun>& now) {
  Setback result;
  for (std::size_t seed = 0; seed < now.size(); ++seed) {
    double loss = 0;
    for (const std::vector<LevelRun>& earlier : before) {
      const double noise = 100 * kStandardErrors *
                           std::hypot(now[seed].level.error.method_error, earlier[seed].level.error.method_error);
      const double worse = difference(now[seed]) - difference(earlier[seed]);
      if (worse > noise) loss = std::max(loss, worse);
    }
    result.seeds += loss > 0;
    result.largest = std::max(result.largest, loss);
  }
  return result;
}

CaseResult measure_search_study(const SearchStudy& study, int seeds,
                                const std::function<LevelRun(int parts, int seed, double setting)>& run) {
  CaseResult result;
  for (const int parts : study.parts) {
    PlotCurve curve{"time", kTimedSolid + ", " + study.level(parts) + ", " + study.name, {}, {}, {}};
    std::vector<std::vector<LevelRun>> all;
    for (const double setting : study.settings) {
      std::vector<LevelRun> runs;
      for (int seed = 1; seed <= seeds; ++seed) runs.push_back(run(parts, seed, setting));
      const Setback lost = setback(all, runs);
      const auto add = [&](const char* what, double value, const char* unit, std::optional<Goal> goal = {}) {
        result.figures.push_back({study.figure(parts, setting, what), value, unit, goal, ""});
      };
      curve.x.push_back(median(runs, [](const LevelRun& one) { return one.cpu_seconds; }));
      curve.y.push_back(median(runs, difference));
      curve.point_names.push_back(study.figure(parts, setting, "run"));
      add("symmetric difference", curve.y.back(), "%");
      add("CPU time", curve.x.back(), "s");
      add("seeds that less time served better", lost.seeds, "-",
          study.is_anytime ? std::optional(at_most(0)) : std::nullopt);
      add("by at most", lost.largest, "% of volume");
      all.push_back(std::move(runs));
    }
    result.curves.push_back(std::move(curve));
  }
  return result;
}

}  // namespace workflows
