// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/goal_rows.h"

#include <cmath>

#include "workflows/bench/level_cost.h"

namespace workflows {
namespace {

using catalog::FitMode;
using Run = const LevelRun&;

// Goals for every level [%]; of edges and faces over the size of their part.
constexpr double kVolumeError = 0.1, kShortestEdge = 1, kNarrowestFace = 2;
// Rounding of the rays' lengths [%], where nothing is missing.
constexpr double kNothing = 1e-9;

std::function<std::optional<Goal>(const GoalRow&)> always(const Goal& goal) {
  return [goal](const GoalRow&) { return goal; };
}

/// The goal for one kind of rows: enclosing ones or the others.
std::function<std::optional<Goal>(const GoalRow&)> if_enclosing(bool is_enclosing, const Goal& goal) {
  return [=](const GoalRow& row) {
    return (row.mode == FitMode::enclosing) == is_enclosing ? std::optional(goal) : std::nullopt;
  };
}

double difference(Run run) { return 100 * run.level.error.symmetric_difference; }

}  // namespace

std::string GoalRow::text() const {
  const std::string text = std::to_string(parts) + " x " + std::to_string(vertex_cap);
  return mode == FitMode::volume_true ? text : text + ", " + mode_name(mode);
}

std::string GoalRow::case_name(int face_cap) const {
  return solid + "-" + ladder_name({parts, vertex_cap, face_cap, mode});
}

const std::vector<GoalRow>& goal_rows() {
  // V-HACD 4.1 and CoACD, scored by the same definitions on the same files.
  static const std::vector<GoalRow> rows{
      {"stone14", 8, 64, FitMode::volume_true, 4.2, 3.8, "9.3 % in 31 CPU s"},
      {"stone14", 8, 32, FitMode::volume_true, 4.4, 4.0, ""},
      {"stone14", 1, 64, FitMode::volume_true, 9.2, 9.0, "17.2 %, 836 vertices"},
      {"stone14", 16, 64, FitMode::volume_true, 3.0, 2.7, "7.9 %, 15 parts"},
      {"stone10", 8, 64, FitMode::volume_true, 3.5, 3.2, ""},
      {"ashlar_1050", 2, 64, FitMode::volume_true, 2.15, 2.05, "4.9 %"},
      {"ashlar_1050", 8, 64, FitMode::volume_true, 1.4, 1.25, ""},
      {"itokawa", 1, 64, FitMode::volume_true, 2.0, 1.8, "7.8 %"},
      {"torus", 8, 64, FitMode::volume_true, 6.2, 5.0, "13.1 %"},
      {"stone14", 8, 64, FitMode::enclosing, 10.0, 8.0, "14 % and more"},
  };
  return rows;
}

const std::vector<RowFigure>& difference_figures() {
  static const std::vector<RowFigure> figures{
      {"symmetric difference, median", "%", "median %", 3, median, difference,
       [](const GoalRow& row) { return std::optional(at_most(row.goal)); }},
      {"symmetric difference, best", "%", "best %", 3, least, difference},
      {"symmetric difference, worst", "%", "worst %", 3, most, difference},
      {"standard error of it, worst", "%", "+- %", 3, most, [](Run run) { return 100 * run.level.error.method_error; }},
  };
  return figures;
}

const std::vector<RowFigure>& error_figures() {
  static const std::vector<RowFigure> figures{
      {"missing volume, median", "%", "missing %", 3, median,
       [](Run run) { return 100 * run.level.error.missing_volume; }},
      {"volume error, median", "%", "volume %", 4, median, [](Run run) { return 100 * run.level.error.volume_error; }},
      {"surface distance both ways, mean", "% of diagonal", "surface: mean %", 3, median,
       [](Run run) { return 100 * run.level.error.surface.mean; }},
      {"surface distance both ways, 95 %", "% of diagonal", "95 %", 2, median,
       [](Run run) { return 100 * run.level.error.surface.percentile_95; }},
      {"surface distance both ways, largest", "% of diagonal", "max", 2, median,
       [](Run run) { return 100 * run.level.error.surface.largest; }},
      {"surface distance from the mesh, mean", "% of diagonal", "from mesh: mean %", 3, median,
       [](Run run) { return 100 * run.level.error.surface_from_mesh.mean; }},
      {"surface distance from the mesh, 95 %", "% of diagonal", "95 %", 2, median,
       [](Run run) { return 100 * run.level.error.surface_from_mesh.percentile_95; }},
      {"surface distance from the mesh, largest", "% of diagonal", "max", 2, median,
       [](Run run) { return 100 * run.level.error.surface_from_mesh.largest; }},
      {"surface distance from the parts, mean", "% of diagonal", "from parts: mean %", 3, median,
       [](Run run) { return 100 * run.level.error.surface_from_union.mean; }},
      {"surface distance from the parts, 95 %", "% of diagonal", "95 %", 2, median,
       [](Run run) { return 100 * run.level.error.surface_from_union.percentile_95; }},
      {"surface distance from the parts, largest", "% of diagonal", "max", 2, median,
       [](Run run) { return 100 * run.level.error.surface_from_union.largest; }},
      {"error of the centre, median", "% of diagonal", "centre %", 3, median,
       [](Run run) { return 100 * run.level.error.centre_error; }},
      {"error of the inertia, median", "%", "inertia %", 2, median,
       [](Run run) { return 100 * run.level.error.inertia_error; }},
      {"error of the convexity, median", "-", "convexity", 4, median,
       [](Run run) { return run.level.error.convexity_error; }},
  };
  return figures;
}

const std::vector<RowFigure>& rule_figures() {
  static const std::vector<RowFigure> figures{
      {"parts kept, median", "-", "parts", 0, median,
       [](Run run) { return static_cast<double>(run.level.parts.size()); }},
      {"vertices, median", "-", "vertices", 0, median, [](Run run) { return 1.0 * run.figures.vertices; }},
      {"faces, median", "-", "faces", 0, median, [](Run run) { return 1.0 * run.figures.faces; }},
      {"faces of a part, most", "-", "most of a part", 0, most, [](Run run) { return 1.0 * run.figures.most_faces; }},
      {"shortest edge, least", "% of part", "shortest edge %", 2, least,
       [](Run run) { return 100 * run.figures.shortest_edge; }, always(at_least(kShortestEdge))},
      {"narrowest face, least", "% of part", "narrowest face %", 2, least,
       [](Run run) { return 100 * run.figures.narrowest_face; }, always(at_least(kNarrowestFace))},
      {"volume error, worst", "%", "volume error %", 4, most,
       [](Run run) { return 100 * std::abs(run.level.error.volume_error); },
       if_enclosing(false, at_most(kVolumeError))},
      {"missing volume, worst", "%", "missing %", 3, most, [](Run run) { return 100 * run.level.error.missing_volume; },
       if_enclosing(true, at_most(kNothing))},
      {"ledges, worst", "% of cuts", "ledges % of cuts", 3, most, [](Run run) { return 100 * run.figures.ledge_area; }},
      {"pairs of parts that overlap, most", "-", "pairs that overlap", 0, most,
       [](Run run) { return 1.0 * run.overlapping_pairs; }, always(at_most(0))},
      {"CPU time of the ladder, median", "s", "CPU s", 1, median, [](Run run) { return run.cpu_seconds; }},
  };
  return figures;
}

std::vector<Figure> row_figures(const GoalRow& row, const std::vector<LevelRun>& runs) {
  const bool is_capped = runs.front().level.key.face_cap > 0;
  std::vector<Figure> figures;
  for (const auto* group : {&difference_figures(), &error_figures(), &rule_figures()})
    for (const RowFigure& figure : *group) {
      const bool has_goal = figure.goal && !(is_capped && group == &difference_figures());
      figures.push_back({figure.name_in(row), figure.over_seeds(runs, figure.of), figure.unit,
                         has_goal ? figure.goal(row) : std::nullopt, ""});
    }
  return figures;
}

}  // namespace workflows
