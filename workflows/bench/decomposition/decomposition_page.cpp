// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/decomposition_page.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "workflows/bench/decomposition/markdown_table.h"
#include "workflows/bench/level_cost.h"
#include "workflows/level_choice.h"

namespace workflows {
namespace {

using Cells = std::vector<std::string>;
using Row = DecompositionResults::Row;

double percent(double share) { return 100 * share; }

std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "an unnamed processor";
}

std::string verdict(const GoalRow& goal, double difference) {
  return difference <= goal.stretch ? "stretch" : difference <= goal.goal ? "goal" : "missed";
}

std::vector<Row> of_cap(const DecompositionResults& results, int face_cap) {
  std::vector<Row> rows;
  for (const Row& row : results.rows)
    if (row.face_cap == face_cap) rows.push_back(row);
  return rows;
}

std::string goals_table(const std::vector<Row>& rows) {
  std::vector<Cells> cells{{"shape", "parts x vertices", "best public", "median %", "best %", "worst %", "+- %",
                            "goal %", "stretch %", "verdict"}};
  for (const Row& row : rows) {
    const auto difference = [](const LevelRun& run) { return percent(run.level.error.symmetric_difference); };
    const double middle = median(row.runs, difference);
    cells.push_back(
        {row.goal.solid, row_text(row.goal), row.goal.best_public.empty() ? "-" : row.goal.best_public,
         fixed(middle, 3), fixed(least(row.runs, difference), 3), fixed(most(row.runs, difference), 3),
         fixed(most(row.runs, [](const LevelRun& run) { return percent(run.level.error.method_error); }), 3),
         fixed(row.goal.goal, 2), fixed(row.goal.stretch, 2), verdict(row.goal, middle)});
  }
  return aligned_markdown(cells);
}

std::string errors_table(const std::vector<Row>& rows) {
  std::vector<Cells> cells{{"shape", "parts x vertices", "missing %", "volume %", "surface mean %", "95 %", "max",
                            "mesh to parts: mean %", "95 %", "max", "parts to mesh: mean %", "95 %", "max", "centre %",
                            "inertia %", "convexity"}};
  for (const Row& row : rows) {
    const auto middle = [&](double share(const catalog::DecompositionError&), int decimals) {
      return fixed(percent(median(row.runs, [&](const LevelRun& run) { return share(run.level.error); })), decimals);
    };
    using Error = const catalog::DecompositionError&;
    cells.push_back(
        {row.goal.solid, row_text(row.goal), middle([](Error e) { return e.missing_volume; }, 3),
         middle([](Error e) { return e.volume_error; }, 4), middle([](Error e) { return e.surface.mean; }, 3),
         middle([](Error e) { return e.surface.percentile_95; }, 2),
         middle([](Error e) { return e.surface.largest; }, 2),
         middle([](Error e) { return e.surface_from_mesh.mean; }, 3),
         middle([](Error e) { return e.surface_from_mesh.percentile_95; }, 2),
         middle([](Error e) { return e.surface_from_mesh.largest; }, 2),
         middle([](Error e) { return e.surface_from_union.mean; }, 3),
         middle([](Error e) { return e.surface_from_union.percentile_95; }, 2),
         middle([](Error e) { return e.surface_from_union.largest; }, 2),
         middle([](Error e) { return e.centre_error; }, 3), middle([](Error e) { return e.inertia_error; }, 2),
         fixed(median(row.runs, [](const LevelRun& run) { return run.level.error.convexity_error; }), 4)});
  }
  return aligned_markdown(cells);
}

std::string rules_table(const std::vector<Row>& rows) {
  std::vector<Cells> cells{{"shape", "parts x vertices", "faces <=", "parts", "vertices", "faces",
                            "most faces of a part", "shortest edge %", "narrowest face %", "volume error %",
                            "ledges % of cuts", "pairs that overlap"}};
  for (const Row& row : rows) {
    const auto count = [&](int of(const LevelRun&)) {
      return fixed(median(row.runs, [&](const LevelRun& run) { return of(run); }), 0);
    };
    using Run = const LevelRun&;
    cells.push_back({row.goal.solid, row_text(row.goal), row.face_cap > 0 ? std::to_string(row.face_cap) : "-",
                     count([](Run run) { return static_cast<int>(run.level.parts.size()); }),
                     count([](Run run) { return run.figures.vertices; }),
                     count([](Run run) { return run.figures.faces; }),
                     fixed(most(row.runs, [](Run run) { return run.figures.most_faces; }), 0),
                     fixed(least(row.runs, [](Run run) { return percent(run.figures.shortest_edge); }), 2),
                     fixed(least(row.runs, [](Run run) { return percent(run.figures.narrowest_face); }), 2),
                     fixed(most(row.runs, [](Run run) { return percent(std::abs(run.level.error.volume_error)); }), 4),
                     fixed(most(row.runs, [](Run run) { return percent(run.figures.ledge_area); }), 3),
                     fixed(most(row.runs, [](Run run) { return run.overlapping_pairs; }), 0)});
  }
  return aligned_markdown(cells);
}

std::string times_table(const DecompositionResults& results) {
  std::vector<Cells> cells{{"what", "verdict", "CPU s", "goal CPU s"}};
  for (const auto& time : results.times)
    cells.push_back({time.what, time.cpu_seconds <= time.goal ? "goal" : "missed", fixed(time.cpu_seconds, 1),
                     fixed(time.goal, 0)});
  return aligned_markdown(cells);
}

std::string efforts_table(const DecompositionResults& results) {
  std::vector<Cells> cells{{"shape", "parts x vertices", "effort", "difference %", "CPU s"}};
  for (const auto& effort : results.efforts)
    cells.push_back({effort.solid, std::to_string(effort.parts) + " x " + std::to_string(effort.vertex_cap),
                     fixed(effort.effort, 2), fixed(percent(effort.difference), 3), fixed(effort.cpu_seconds, 2)});
  return aligned_markdown(cells);
}

/// Whether no other level of the same solid is at most as dear and at most as wrong.
bool is_on_front(const DecompositionResults::Front& one, const std::vector<DecompositionResults::Front>& all) {
  const auto error = [](const auto& of) { return of.run.level.error.symmetric_difference; };
  return std::none_of(all.begin(), all.end(), [&](const auto& other) {
    return other.solid == one.solid && other.cost <= one.cost && error(other) <= error(one) &&
           (other.cost < one.cost || error(other) < error(one));
  });
}

std::string front_table(const DecompositionResults& results) {
  std::vector<DecompositionResults::Front> front;
  for (const auto& one : results.front)
    if (is_on_front(one, results.front)) front.push_back(one);
  std::stable_sort(front.begin(), front.end(), [](const auto& a, const auto& b) {
    return a.solid != b.solid ? a.solid < b.solid : a.cost < b.cost;
  });
  std::vector<Cells> cells{
      {"shape", "level", "parts", "vertices", "faces", "difference %", "measured cost", "by formula"}};
  for (const auto& one : front) {
    Level level;
    level.parts = static_cast<int>(one.run.level.parts.size());
    level.faces = one.run.figures.faces;
    cells.push_back({one.solid, std::to_string(one.run.level.key.parts_asked) + " x " + ladder_text(one.run.level.key),
                     std::to_string(level.parts), std::to_string(one.run.figures.vertices), std::to_string(level.faces),
                     fixed(percent(one.run.level.error.symmetric_difference), 3), fixed(one.cost, 1),
                     fixed(contact_cost(level), 1)});
  }
  return aligned_markdown(cells);
}

/// A heading, a line of text and a table, if there is anything to show.
std::string section(const std::string& heading, const std::string& text, bool is_shown, const std::string& table) {
  return is_shown ? "\n## " + heading + "\n\n" + text + "\n\n" + table : "";
}

}  // namespace

std::string decomposition_page(const DecompositionResults& results) {
  std::string page =
      "# Convex decomposition: error, time, front\n\nWritten by `talus bench decomposition --scans DIR` (" +
      std::to_string(results.seeds) + " seeds a row) on " + machine() +
      ". Errors are those of the measure that stands apart from the search: volumes by exact rays, "
      "surfaces by sample points. Errors and rules are the same on every machine, times are not.\n";
  if (!results.left_out.empty()) {
    page += "\nNot measured, for want of files:";
    for (const std::string& name : results.left_out) page += " " + name;
    page += ".\n";
  }
  const std::vector<Row> uncapped = of_cap(results, 0);
  page +=
      section("Symmetric difference",
              "Of the union of parts to the mesh, over the mesh's volume; median, best and worst of the seeds; +- is "
              "the standard error of the measurement (worst). Best public: V-HACD 4.1 and CoACD on the same files.",
              !uncapped.empty(), uncapped.empty() ? "" : goals_table(uncapped));
  for (const int cap : kFaceCaps) {
    const std::vector<Row> rows = of_cap(results, cap);
    if (cap == 0 || rows.empty()) continue;
    page += section("The same under a cap of " + std::to_string(cap) + " faces a part",
                    "Faces on one plane are one. Goals are those without the cap, for comparison.", true,
                    goals_table(rows));
  }
  page +=
      section("Other errors",
              "Medians of the seeds. Distances over the diagonal of the mesh's bounding box: both ways, from points "
              "of the mesh to the parts, from points of the parts to the mesh. Centre over the diagonal; inertia "
              "tensor over its norm; convexity is the difference in V / V_hull.",
              !uncapped.empty(), uncapped.empty() ? "" : errors_table(uncapped));
  page += section("Rules",
                  "Counts are medians, the others the worst of the seeds. Edges and faces over the size of their part "
                  "(asked for: 1 % and 2 %), volume error at most 0.1 % (volume-true), no overlap, tested exactly.",
                  !results.rows.empty(), results.rows.empty() ? "" : rules_table(results.rows));
  page += section("Time", "CPU time of all threads, measuring included; medians of at most three seeds.",
                  !results.times.empty(), times_table(results));
  page += section("Effort", "What more search gains (`--effort`); medians of at most three seeds.",
                  !results.efforts.empty(), efforts_table(results));
  page +=
      section("Front",
              "The levels that no other of the shape beats in both error and cost (seed 1; ladders of 1 to 32 parts "
              "under each cap). Cost: time of a contact of two such bodies in the engine over that of two cubes, "
              "measured, and by the formula that scenes choose levels with.",
              !results.front.empty(), front_table(results));
  return page;
}

}  // namespace workflows
