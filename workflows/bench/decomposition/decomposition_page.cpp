// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/decomposition_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "workflows/bench/decomposition/bench_levels.h"
#include "workflows/bench/decomposition/goal_rows.h"
#include "workflows/bench/report_page.h"

namespace workflows {
namespace {

using Cells = std::vector<std::string>;

// How the names of the cases begin that are not rows of goals.
constexpr const char* kBesideRows[] = {"time-", "effort-", "budget-", "front-"};

/// The rows measured under a cap of faces.
std::vector<GoalRow> measured_rows(const FigureTable& figures, int face_cap) {
  std::vector<GoalRow> rows = goal_rows();
  std::erase_if(rows, [&](const GoalRow& row) {
    return std::isnan(figures(row.case_name(face_cap), difference_figures().front().name_in(row)));
  });
  return rows;
}

void add_columns(Cells& header, const std::vector<RowFigure>& columns) {
  for (const RowFigure& column : columns) header.push_back(column.heading);
}

void add_figures(Cells& cells, const FigureTable& figures, const GoalRow& row, int face_cap,
                 const std::vector<RowFigure>& columns) {
  for (const RowFigure& column : columns)
    cells.push_back(fixed(figures(row.case_name(face_cap), column.name_in(row)), column.decimals));
}

std::string goals_table(const FigureTable& figures, const std::vector<GoalRow>& rows, int face_cap) {
  std::vector<Cells> table{{"shape", "parts x vertices", "best public"}};
  add_columns(table.front(), difference_figures());
  table.front().insert(table.front().end(), {"goal %", "stretch %", "verdict"});
  for (const GoalRow& row : rows) {
    table.push_back({row.solid, row.text(), row.best_public.empty() ? "-" : row.best_public});
    add_figures(table.back(), figures, row, face_cap, difference_figures());
    const double median = figures(row.case_name(face_cap), difference_figures().front().name_in(row));
    const char* verdict = median <= row.stretch ? "stretch" : median <= row.goal ? "goal" : "missed";
    table.back().insert(table.back().end(), {fixed(row.goal, 2), fixed(row.stretch, 2), verdict});
  }
  return aligned_markdown(table);
}

std::string errors_table(const FigureTable& figures, const std::vector<GoalRow>& rows) {
  std::vector<Cells> table{{"shape", "parts x vertices"}};
  add_columns(table.front(), error_figures());
  for (const GoalRow& row : rows) {
    table.push_back({row.solid, row.text()});
    add_figures(table.back(), figures, row, 0, error_figures());
  }
  return aligned_markdown(table);
}

std::string rules_table(const FigureTable& figures) {
  std::vector<Cells> table{{"shape", "parts x vertices", "faces <="}};
  add_columns(table.front(), rule_figures());
  for (const int cap : kFaceCaps)
    for (const GoalRow& row : measured_rows(figures, cap)) {
      table.push_back({row.solid, row.text(), cap > 0 ? std::to_string(cap) : "-"});
      add_figures(table.back(), figures, row, cap, rule_figures());
    }
  return aligned_markdown(table);
}

std::string times_table(const FigureTable& figures) {
  std::vector<Cells> table{{"what", "verdict", "CPU s", "goal CPU s"}};
  for (const TimeGoal& goal : kTimeGoals) {
    const double time = figures(kTimeCase, goal.name);
    table.push_back({kTimedSolid + ", " + goal.name, time <= goal.seconds ? "goal" : "missed", fixed(time, 1),
                     fixed(goal.seconds, 0)});
  }
  return aligned_markdown(table);
}

std::string study_table(const FigureTable& figures, const std::string& case_name, const SearchStudy& study) {
  std::vector<Cells> table{{"shape", "parts x vertices", study.name + (study.unit.empty() ? "" : " [s]"),
                            "difference %", "CPU s", "seeds worse than with less", "by at most %"}};
  for (const int parts : study.parts)
    for (const double setting : study.settings) {
      const auto cell = [&](const char* what, int decimals) {
        return fixed(figures(case_name, study.figure(parts, setting, what)), decimals);
      };
      table.push_back({kTimedSolid, study.level(parts), fixed(setting, setting < 1 ? 2 : 0),
                       cell("symmetric difference", 3), cell("CPU time", 2),
                       cell("seeds that less time served better", 0), cell("by at most", 3)});
    }
  return aligned_markdown(table);
}

/// Whether more time ever made a level worse, in words.
std::string anytime_text(const FigureTable& figures) {
  double seeds = 0, most = 0;
  for (const int parts : kBudgetStudy.parts)
    for (const double setting : kBudgetStudy.settings) {
      seeds += figures(kBudgetCase, kBudgetStudy.figure(parts, setting, "seeds that less time served better"));
      most = std::max(most, figures(kBudgetCase, kBudgetStudy.figure(parts, setting, "by at most")));
    }
  if (seeds == 0) return "Here more time never made a level worse.";
  return "Here more time made a level worse " + (seeds == 1 ? "once" : fixed(seeds, 0) + " times") + ", by " +
         fixed(most, 3) + " % of the volume at most.";
}

struct FrontLevel {
  catalog::LevelKey key;
  double difference, cost;
};

/// The levels measured that no other is at most as dear and at most as wrong as, cheapest first.
std::vector<FrontLevel> front_of(const FigureTable& figures, const FrontCase& one) {
  std::vector<FrontLevel> levels;
  for (catalog::LevelKey key : one.ladders)
    for (const int parts : kLadder) {
      key.parts_asked = parts;
      const double cost = figures(one.name(), front_figure(key, "time of a contact over that of cubes"));
      if (!std::isnan(cost))
        levels.push_back({key, figures(one.name(), front_figure(key, "symmetric difference")), cost});
    }
  std::vector<FrontLevel> front;
  for (const FrontLevel& level : levels)
    if (std::none_of(levels.begin(), levels.end(), [&](const FrontLevel& other) {
          return other.cost <= level.cost && other.difference <= level.difference &&
                 (other.cost < level.cost || other.difference < level.difference);
        }))
      front.push_back(level);
  std::stable_sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  return front;
}

std::string front_table(const FigureTable& figures) {
  const Cells others{"parts kept", "vertices", "faces", "contact_cost"};
  std::vector<Cells> table{
      {"shape", "level", "difference %", "measured cost", "parts", "vertices", "faces", "cost by formula"}};
  for (const FrontCase& one : kFrontCases)
    for (const FrontLevel& level : front_of(figures, one)) {
      table.push_back({one.solid, std::to_string(level.key.parts_asked) + " x " + ladder_text(level.key),
                       fixed(level.difference, 3), fixed(level.cost, 1)});
      for (const std::string& what : others)
        table.back().push_back(
            fixed(figures(one.name(), front_figure(level.key, what)), what == others.back() ? 1 : 0));
    }
  return aligned_markdown(table);
}

/// Whether a case has been run.
bool has_case(const std::vector<ReportedFigure>& figures, const std::string& beginning) {
  return std::any_of(figures.begin(), figures.end(),
                     [&](const ReportedFigure& reported) { return reported.case_name.starts_with(beginning); });
}

std::string section(const std::string& heading, const std::string& text, const std::string& table) {
  return "\n## " + heading + "\n\n" + text + "\n\n" + table;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// CPU time of the cases measured, rows apart from what is measured beside them.
std::string spent_text(const FigureTable& figures, const std::vector<std::string>& cases) {
  double rows = 0, rest = 0;
  int timed = 0;
  for (const std::string& name : cases) {
    const double time = figures(name, kCaseTime);
    if (std::isnan(time)) continue;
    ++timed;
    const bool is_beside = std::any_of(std::begin(kBesideRows), std::end(kBesideRows),
                                       [&](const char* beginning) { return name.starts_with(beginning); });
    (is_beside ? rest : rows) += time;
  }
  return (timed == static_cast<int>(cases.size())
              ? std::string("This page")
              : "The " + std::to_string(timed) + " of " + std::to_string(cases.size()) + " cases that were timed") +
         " took " + fixed((rows + rest) / 60, 1) + " CPU minutes: " + fixed(rows / 60, 1) + " for the rows of goals, " +
         fixed(rest / 60, 1) + " for times, gains of effort and time, and fronts.";
}

std::string head(const std::vector<ReportedFigure>& figures, const PageFrame& frame) {
  std::string page = "# Convex decomposition: error, time, front\n\nWritten by `talus bench decomposition --scans DIR" +
                     (frame.seeds == BenchOptions{}.seeds ? "" : " --seeds " + std::to_string(frame.seeds)) + "` on " +
                     today() + ", " + std::to_string(frame.seeds) + (frame.seeds == 1 ? " seed" : " seeds") +
                     " a row, on " + processor_name() +
                     ". Errors are those of the measure that stands apart from the search: volumes by exact rays, "
                     "surfaces by sample points. Errors and rules are the same on every machine, times are not. " +
                     spent_text(FigureTable(figures), frame.cases) + "\n";
  if (!frame.left_out.empty()) page += "\nNot measured, for want of files: " + listed(frame.left_out) + ".\n";
  std::vector<std::string> not_run = frame.cases;
  std::erase_if(not_run, [&](const std::string& name) {
    return std::any_of(figures.begin(), figures.end(), [&](const auto& one) { return one.case_name == name; });
  });
  if (!not_run.empty())
    page += "\nNot run (`--case NAME` measures one, `--resume` all that are missing): " + listed(not_run) + ".\n";
  return page;
}

/// The tables of goals under each cap of faces, and what else is known of their rows.
std::string rows_sections(const FigureTable& table) {
  std::string page;
  for (const int cap : kFaceCaps) {
    const std::vector<GoalRow> rows = measured_rows(table, cap);
    if (rows.empty()) continue;
    if (cap > 0)
      page += section("The same under a cap of " + std::to_string(cap) + " faces a part",
                      "Faces on one plane are one. Goals are those without the cap, for comparison.",
                      goals_table(table, rows, cap));
    else
      page += section("Symmetric difference",
                      "Of the union of parts to the mesh, over the mesh's volume; median, best and worst of the seeds; "
                      "+- is the standard error of the measurement (worst). Best public: V-HACD 4.1 and CoACD on the "
                      "same files.",
                      goals_table(table, rows, cap));
  }
  if (const std::vector<GoalRow> rows = measured_rows(table, 0); !rows.empty())
    page += section("Other errors",
                    "Medians of the seeds. Distances over the diagonal of the mesh's bounding box: both ways, from "
                    "points of the mesh to the parts, from points of the parts to the mesh. Centre over the diagonal; "
                    "inertia tensor over its norm; convexity is the difference in V / V_hull.",
                    errors_table(table, rows));
  if (!page.empty())
    page += section("Rules",
                    "Counts and CPU time (of the ladder that holds the level, measuring included) are medians, the "
                    "others the worst of the seeds. Asked for: edges at least 1 % and faces 2 % of the size of their "
                    "part, volume error at most 0.1 % (volume-true), nothing missing (enclosing), no overlap, which is "
                    "tested exactly.",
                    rules_table(table));
  return page;
}

}  // namespace

std::string decomposition_page(const std::vector<ReportedFigure>& figures, const PageFrame& frame) {
  const FigureTable table(figures);
  std::string page = head(figures, frame) + rows_sections(table);
  if (has_case(figures, kTimeCase))
    page += section("Time", "CPU time of all threads, measuring included; medians of at most three seeds.",
                    times_table(table));
  if (has_case(figures, kEffortCase))
    page += section("Effort", "What more search gains (`--effort`); medians of at most three seeds.",
                    study_table(table, kEffortCase, kEffortStudy));
  if (has_case(figures, kBudgetCase))
    page += section("Time budget",
                    "What more time gains (`--time-budget`: searches of growing effort, the best kept); medians of at "
                    "most three seeds. A seed is worse than with less time where its "
                    "difference is above one found with less by more than three standard errors of the measurement. " +
                        anytime_text(table),
                    study_table(table, kBudgetCase, kBudgetStudy));
  if (has_case(figures, "front-"))
    page += section("Front",
                    "The levels that no other of the shape beats in both error and cost (seed 1; ladders of 1 to 32 "
                    "parts under each cap). Cost: time of a contact of two such bodies in the engine over that of two "
                    "cubes, measured, and by the formula that scenes choose levels with.",
                    front_table(table));
  return page;
}

}  // namespace workflows
