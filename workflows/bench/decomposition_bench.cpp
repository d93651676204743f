// SPDX-License-Identifier: GPL-3.0-or-later
// Convex decomposition: error against goals, rules, time, and the front of error against cost.
#include <algorithm>
#include <map>
#include <memory>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/decomposition/decomposition_page.h"
#include "workflows/bench/decomposition/goal_rows.h"
#include "workflows/bench/decomposition/ladder_runs.h"
#include "workflows/bench/decomposition/solids.h"
#include "workflows/bench/level_cost.h"

namespace workflows {
namespace {

using catalog::LevelKey;
using decomposition::DecompositionOptions;

const std::vector<int> kLadder{1, 2, 4, 8, 16, 32};
/// Times and gains of effort: medians over this many seeds at most.
constexpr int kTimedSeeds = 3;
/// The 30,000-face scan of the goals for time [CPU s].
constexpr const char* kTimedSolid = "stone14";
constexpr double kLevelTime = 5, kLadderTime = 25;

/// What the cases share while the bench runs.
struct Workbench {
  BenchSolids solids;
  int seeds, threads;
  DecompositionResults results;

  DecompositionOptions options(const LevelKey& caps, int seed) const {
    DecompositionOptions options;
    options.vertex_cap = caps.vertex_cap;
    options.face_cap = caps.face_cap;
    options.mode = caps.mode;
    options.seed = static_cast<std::uint64_t>(seed);
    options.threads = threads;
    return options;
  }
};

/// The rows of one solid, mode and cap of vertices under one cap of faces, which share a ladder for each seed.
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
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Figure& figure : row_figures(rows[r], runs[r])) result.figures.push_back(std::move(figure));
    bench.results.rows.push_back({rows[r], face_cap, std::move(runs[r])});
  }
  return result;
}

CaseResult measure_time(Workbench& bench) {
  CaseResult result;
  const int seeds = std::min(bench.seeds, kTimedSeeds);
  for (const auto& [what, parts, goal] : {std::tuple{"8 parts x 64 vertices", std::vector<int>{8}, kLevelTime},
                                          {"ladder of 1, 2, 4, 8, 16, 32 parts x 64 vertices", kLadder, kLadderTime}}) {
    std::vector<LevelRun> runs;
    for (int seed = 1; seed <= seeds; ++seed)
      runs.push_back(run_ladder(bench.solids.mesh(kTimedSolid), parts, bench.options({0, 64}, seed)).front());
    const double time = median(runs, [](const LevelRun& run) { return run.cpu_seconds; });
    result.figures.push_back({std::string(what) + ", CPU time, median", time, "s", at_most(goal), ""});
    bench.results.times.push_back({std::string(kTimedSolid) + ", " + what, time, goal});
  }
  return result;
}

CaseResult measure_effort(Workbench& bench) {
  constexpr int kVertexCap = 64;
  CaseResult result;
  for (const int parts : {2, 8, 16}) {
    const std::string level = std::to_string(parts) + " x " + std::to_string(kVertexCap);
    PlotCurve curve{"time", std::string(kTimedSolid) + ", " + level, {}, {}, {}};
    for (const double effort : {0.25, 1.0, 4.0}) {
      std::vector<LevelRun> runs;
      for (int seed = 1; seed <= std::min(bench.seeds, kTimedSeeds); ++seed) {
        DecompositionOptions options = bench.options({0, kVertexCap}, seed);
        options.effort = effort;
        runs.push_back(run_ladder(bench.solids.mesh(kTimedSolid), {parts}, options).front());
      }
      const double difference = median(runs, [](const LevelRun& run) { return run.level.error.symmetric_difference; });
      const double time = median(runs, [](const LevelRun& run) { return run.cpu_seconds; });
      const std::string at = std::to_string(static_cast<int>(100 * effort)) + " % of the usual effort";
      result.figures.push_back({level + ", " + at + ": symmetric difference", 100 * difference, "%", {}, ""});
      result.figures.push_back({level + ", " + at + ": CPU time", time, "s", {}, ""});
      bench.results.efforts.push_back({kTimedSolid, parts, kVertexCap, effort, difference, time});
      curve.x.push_back(time);
      curve.y.push_back(difference);
      curve.point_names.push_back(at);
    }
    result.curves.push_back(std::move(curve));
  }
  return result;
}

/// Ladders under several caps, each level with what a contact of it costs the engine.
CaseResult measure_front(Workbench& bench, const std::string& solid, const std::vector<LevelKey>& ladders) {
  CaseResult result;
  for (const LevelKey& caps : ladders) {
    PlotCurve size{"size", solid + ", " + ladder_text(caps), {}, {}, {}}, cost = size;
    cost.plot = "cost";
    for (LevelRun& run : run_ladder(bench.solids.mesh(solid), kLadder, bench.options(caps, 1))) {
      const double difference = run.level.error.symmetric_difference, paid = measured_contact_cost(run.level);
      const int parts = run.level.key.parts_asked;
      const std::string level = ladder_name(run.level.key) + ", " + std::to_string(parts) + " parts: ";
      result.figures.push_back({level + "symmetric difference", 100 * difference, "%", {}, ""});
      result.figures.push_back({level + "time of a contact over that of cubes", paid, "-", {}, ""});
      size.x.push_back(parts * caps.vertex_cap);
      cost.x.push_back(paid);
      for (PlotCurve* curve : {&size, &cost}) {
        curve->y.push_back(difference);
        curve->point_names.push_back(std::to_string(parts) + " parts");
      }
      bench.results.front.push_back({solid, std::move(run), paid});
    }
    if (caps.face_cap == 0) result.curves.push_back(std::move(size));
    result.curves.push_back(std::move(cost));
  }
  return result;
}

void add_row_cases(BenchPlan& plan, const std::shared_ptr<Workbench>& bench) {
  for (const int face_cap : kFaceCaps) {
    std::vector<std::pair<std::string, std::vector<GoalRow>>> groups;
    for (const GoalRow& row : goal_rows()) {
      if (!bench->solids.has(row.solid)) continue;
      const std::string name = row.solid + "-" + ladder_name({0, row.vertex_cap, face_cap, row.mode});
      const auto known = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == name; });
      if (known == groups.end())
        groups.push_back({name, {row}});
      else
        known->second.push_back(row);
    }
    for (const auto& [name, rows] : groups)
      plan.cases.push_back({name, [bench, rows = rows, face_cap] { return measure_rows(*bench, rows, face_cap); }});
  }
}

}  // namespace

BenchPlan plan_decomposition_bench(const BenchOptions& options) {
  const auto bench = std::make_shared<Workbench>(
      Workbench{BenchSolids(options.scans), options.seeds, options.threads.empty() ? 1 : options.threads.front(), {}});
  bench->results.left_out = bench->solids.missing();
  bench->results.seeds = options.seeds;
  BenchPlan plan;
  add_row_cases(plan, bench);
  if (bench->solids.has(kTimedSolid)) {
    plan.cases.push_back({std::string("time-") + kTimedSolid, [bench] { return measure_time(*bench); }});
    plan.cases.push_back({std::string("effort-") + kTimedSolid, [bench] { return measure_effort(*bench); }});
  }
  // The first is drawn at every cap, the others at the usual one: seven curves can be told apart.
  const std::vector<LevelKey> usual{{0, 64}}, all{{0, 16}, {0, 32}, {0, 64}, {0, 64, 24}, {0, 64, 34}};
  for (const std::string solid : {"stone14", "ashlar_1050", "itokawa", "torus"})
    if (bench->solids.has(solid))
      plan.cases.push_back({"front-" + solid, [bench, solid, ladders = solid == kTimedSolid ? all : usual] {
                              return measure_front(*bench, solid, ladders);
                            }});
  plan.plots = {{"size", "Error against size of the level", "parts x vertices", "symmetric difference [-]"},
                {"cost", "Error against what the engine pays", "time of a contact [contacts of cubes]",
                 "symmetric difference [-]"},
                {"time", "Error against time for the search", "CPU time [s]", "symmetric difference [-]"}};
  plan.page = [bench] { return decomposition_page(bench->results); };
  return plan;
}

}  // namespace workflows
