// SPDX-License-Identifier: GPL-3.0-or-later
// Convex decomposition: error against goals, rules, time, and the front of error against cost.
#include <algorithm>
#include <memory>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/decomposition/bench_levels.h"
#include "workflows/bench/decomposition/decomposition_page.h"
#include "workflows/bench/decomposition/goal_rows.h"
#include "workflows/bench/decomposition/ladder_runs.h"
#include "workflows/bench/decomposition/search_study.h"
#include "workflows/bench/decomposition/solids.h"
#include "workflows/level_choice.h"

namespace workflows {
namespace {

using catalog::LevelKey;
using decomposition::DecompositionOptions;

/// Times and gains of effort: medians over this many seeds at most.
constexpr int kTimedSeeds = 3;

double difference_of(const LevelRun& run) { return 100 * run.level.error.symmetric_difference; }
double time_of(const LevelRun& run) { return run.cpu_seconds; }

/// What the cases share while the bench runs.
struct Workbench {
  BenchSolids solids;
  int seeds, threads;

  DecompositionOptions options(const LevelKey& caps, int seed, double effort = 1) const {
    DecompositionOptions options;
    options.vertex_cap = caps.vertex_cap;
    options.face_cap = caps.face_cap;
    options.mode = caps.mode;
    options.seed = static_cast<std::uint64_t>(seed);
    options.effort = effort;
    options.threads = threads;
    return options;
  }
};

/// The rows of one case, which share a ladder for each seed.
CaseResult measure_rows(Workbench& bench, const std::vector<GoalRow>& rows, int face_cap) {
  const LevelKey caps{0, rows.front().vertex_cap, face_cap, rows.front().mode};
  std::vector<int> parts;
  for (const GoalRow& row : rows) parts.push_back(row.parts);
  std::vector<std::vector<LevelRun>> runs(rows.size());
  for (int seed = 1; seed <= bench.seeds; ++seed) {
    std::vector<LevelRun> ladder = run_ladder(bench.solids.mesh(rows.front().solid), parts, bench.options(caps, seed));
    for (std::size_t r = 0; r < rows.size(); ++r) runs[r].push_back(std::move(ladder[r]));
  }
  CaseResult result;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (Figure& figure : row_figures(rows[r], runs[r])) result.figures.push_back(std::move(figure));
  return result;
}

CaseResult measure_time(Workbench& bench) {
  CaseResult result;
  for (const TimeGoal& goal : kTimeGoals) {
    std::vector<LevelRun> runs;
    for (int seed = 1; seed <= std::min(bench.seeds, kTimedSeeds); ++seed)
      runs.push_back(run_ladder(bench.solids.mesh(kTimedSolid), goal.parts, bench.options({0, 64}, seed)).front());
    result.figures.push_back({goal.name, median(runs, time_of), "s", at_most(goal.seconds), ""});
  }
  return result;
}

CaseResult measure_effort(Workbench& bench) {
  return measure_search_study(
      kEffortStudy, std::min(bench.seeds, kTimedSeeds), [&](int parts, int seed, double effort) {
        const DecompositionOptions options = bench.options({0, kEffortStudy.vertex_cap}, seed, effort);
        return run_ladder(bench.solids.mesh(kTimedSolid), {parts}, options).front();
      });
}

CaseResult measure_budgets(Workbench& bench) {
  return measure_search_study(kBudgetStudy, std::min(bench.seeds, kTimedSeeds),
                              [&](int parts, int seed, double budget) {
                                DecompositionOptions options = bench.options({0, kBudgetStudy.vertex_cap}, seed);
                                options.time_budget = budget;
                                return run_ladder(bench.solids.mesh(kTimedSolid), {parts}, options).front();
                              });
}

/// Figures of one level with what a contact of it costs the engine; returns that cost.
double add_front_level(const LevelRun& run, CaseResult& result) {
  Level level;
  level.parts = static_cast<int>(run.level.parts.size());
  level.faces = run.figures.faces;
  const double cost = measured_contact_cost(unit_shape("level", run.level));
  const auto add = [&](const char* what, double value, const char* unit) {
    result.figures.push_back({front_figure(run.level.key, what), value, unit, {}, ""});
  };
  add("symmetric difference", difference_of(run), "%");
  add("time of a contact over that of cubes", cost, "-");
  add("contact_cost", contact_cost(level), "-");
  add("parts kept", level.parts, "-");
  add("vertices", run.figures.vertices, "-");
  add("faces", level.faces, "-");
  return cost;
}

CaseResult measure_front(Workbench& bench, const FrontCase& front) {
  CaseResult result;
  for (const LevelKey& caps : front.ladders) {
    PlotCurve size{"size", front.solid + ", " + ladder_text(caps), {}, {}, {}}, cost = size;
    cost.plot = front.ladders.size() > 1 ? "caps" : "cost";
    for (const LevelRun& run : run_ladder(bench.solids.mesh(front.solid), kLadder, bench.options(caps, 1))) {
      size.x.push_back(run.level.key.parts_asked * caps.vertex_cap);
      cost.x.push_back(add_front_level(run, result));
      for (PlotCurve* curve : {&size, &cost}) {
        curve->y.push_back(difference_of(run));
        curve->point_names.push_back(std::to_string(run.level.key.parts_asked) + " parts");
      }
    }
    if (caps.face_cap == 0) result.curves.push_back(std::move(size));
    // One plot compares the caps on one solid, another the solids under one cap.
    if (front.ladders.size() > 1 && caps == kFrontCaps) {
      result.curves.push_back(cost);
      result.curves.back().plot = "cost";
    }
    result.curves.push_back(std::move(cost));
  }
  return result;
}

/// The same case with its time as one more figure.
std::function<CaseResult()> timed(const std::function<CaseResult()>& measure) {
  return [measure] {
    const ProcessClock clock;
    CaseResult result = measure();
    result.figures.push_back({kCaseTime, clock.seconds(), "s", {}, ""});
    return result;
  };
}

void add_row_cases(BenchPlan& plan, const std::shared_ptr<Workbench>& bench) {
  for (const int face_cap : kFaceCaps) {
    std::vector<std::vector<GoalRow>> groups;
    for (const GoalRow& row : goal_rows()) {
      if (!bench->solids.has(row.solid)) continue;
      const auto known = std::find_if(groups.begin(), groups.end(), [&](const std::vector<GoalRow>& group) {
        return group.front().case_name(face_cap) == row.case_name(face_cap);
      });
      if (known == groups.end())
        groups.push_back({row});
      else
        known->push_back(row);
    }
    for (const std::vector<GoalRow>& rows : groups)
      plan.cases.push_back(
          {rows.front().case_name(face_cap), [bench, rows, face_cap] { return measure_rows(*bench, rows, face_cap); }});
  }
}

}  // namespace

BenchPlan plan_decomposition_bench(const BenchOptions& options) {
  const auto bench = std::make_shared<Workbench>(
      Workbench{BenchSolids(options.scans), options.seeds, options.threads.empty() ? 1 : options.threads.front()});
  BenchPlan plan;
  add_row_cases(plan, bench);
  if (bench->solids.has(kTimedSolid)) {
    plan.cases.push_back({kTimeCase, [bench] { return measure_time(*bench); }});
    plan.cases.push_back({kEffortCase, [bench] { return measure_effort(*bench); }});
    plan.cases.push_back({kBudgetCase, [bench] { return measure_budgets(*bench); }});
  }
  for (const FrontCase& front : kFrontCases)
    if (bench->solids.has(front.solid))
      plan.cases.push_back({front.name(), [bench, front] { return measure_front(*bench, front); }});
  PageFrame frame{bench->solids.missing(), {}, options.seeds};
  for (BenchCase& one : plan.cases) {
    frame.cases.push_back(one.name);
    one.measure = timed(one.measure);
  }
  const std::string difference = "symmetric difference [%]", cost = "time of a contact [contacts of cubes]";
  plan.plots = {{"size", "Error against size of the level", "parts x vertices", difference},
                {"cost", "Error against what the engine pays, shapes", cost, difference},
                {"caps", "Error against what the engine pays, caps of vertices and faces", cost, difference},
                {"time", "Error against time for the search", "CPU time [s]", difference}};
  plan.page = [frame](const std::vector<ReportedFigure>& figures) { return decomposition_page(figures, frame); };
  return plan;
}

}  // namespace workflows
