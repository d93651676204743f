// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace workflows {

/// The bound a figure is asked to keep.
struct Goal {
  enum class Sense { at_most, at_least } sense;
  double bound;
};
inline Goal at_most(double bound) { return {Goal::Sense::at_most, bound}; }
inline Goal at_least(double bound) { return {Goal::Sense::at_least, bound}; }

/// One measured number. A run that failed has no value but says why.
struct Figure {
  std::string name;
  std::optional<double> value;
  std::string unit;
  std::optional<Goal> goal;
  std::string failure;
};

/// Stands for a run that failed, in a curve.
inline constexpr double kFailedRun = std::numeric_limits<double>::quiet_NaN();

/// One line of a plot; points that are kFailedRun are named as failed instead of drawn. Curves of several cases with
/// one label are one line, in the order of the cases.
struct PlotCurve {
  std::string plot;  // PlotAxes::name
  std::string label;
  std::vector<double> x, y;              // n_points
  std::vector<std::string> point_names;  // n_points, for naming what failed
  bool is_reference = false;             // points without a line: somebody else's
};

struct CaseResult {
  std::vector<Figure> figures;
  std::vector<PlotCurve> curves;
};

/// What `--case NAME` runs alone.
struct BenchCase {
  std::string name;
  std::function<CaseResult()> measure;
  std::string inputs{};   // hashes of what it measures, so that a case is kept as long as these stay; empty: all inputs
  bool is_apart = false;  // takes so long that only --case NAME runs it
};

/// A plot, with logarithmic axes unless `is_linear`; each curve that names it is drawn in it.
struct PlotAxes {
  std::string name;  // of the file
  std::string title;
  std::string x_label;  // with its unit: "time [s]"
  std::string y_label;
  bool is_linear = false;
};

/// A figure with where it comes from.
struct ReportedFigure {
  std::string bench;
  std::string case_name;
  Figure figure;
  std::string command;  // what a reader types to get it alone
};

struct BenchPlan {
  std::vector<BenchCase> cases;
  std::vector<PlotAxes> plots;
  /// Markdown of what was measured; empty: a table of all figures.
  std::function<std::string(const std::vector<ReportedFigure>&)> page{};
  /// What options leave out that the bench cannot do without, to show to the user; empty: nothing. Its cases then stand
  /// for those it would have, and must not be measured.
  std::string lacks{};
};

struct BenchOptions {
  std::vector<int> threads;         // counts to compare, where a bench runs the engine's threads
  std::filesystem::path catalogue;  // of shapes, where a bench measures them
  std::filesystem::path scans;      // folder of scans, where a bench measures them
  int seeds = 5;                    // of searches, where a bench takes the median over them
};

}  // namespace workflows
