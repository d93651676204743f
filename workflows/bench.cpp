// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "catalog/shape_catalog.h"
#include "workflows/atomic_file.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_report.h"
#include "workflows/bench/case_file.h"
#include "workflows/bench/log_plot.h"
#include "workflows/command_options.h"
#include "workflows/stage_tool.h"
#include "workflows/thread_count.h"

namespace {

namespace fs = std::filesystem;
using namespace workflows;

constexpr const char* kHelp = R"(Example: talus bench overlap

Measures speed and error on named cases.

  talus bench --list
  talus bench contact --json results/contact.json
  talus bench laws --case face-slide-depth
  talus bench decomposition --scans scans/ --out results    (where decomposition is built)

The table goes to stdout. --json FILE writes one JSON object a line; beside it stand the table in Markdown and the plots
in SVG; the finished cases are kept in FILE.cases, so that a bench that was stopped goes on with --resume. Exit status 4
if a goal is missed or a run failed.)";

struct Options {
  std::string bench;
  std::string only_case;  // empty: all
  fs::path json;          // empty: none
  fs::path out;           // folder of table and plots; empty: beside --json
  std::vector<int> threads;
  fs::path catalogue;  // empty: none
  fs::path scans;      // empty: none
  int seeds = 5;
  bool is_list = false;
  bool resumes = false;  // with the cases that are kept
};

/// Refuses options that the bench would pass over.
void refuse_options_of_others(const CLI::App& app, const std::string& name) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> users{
      {"--catalog", {"levels", "parts"}},
      {"--scans", {"decomposition", "digitize", "micrographs"}},
      {"--seeds", {"decomposition"}}};
  const std::string& bench = bench_named(name).name;
  for (const auto& [option, benches] : users) {
    if (app.count(option) == 0 || std::find(benches.begin(), benches.end(), bench) != benches.end()) continue;
    std::string names;
    for (const std::string& user : benches)
      names += (names.empty() ? "" : user == benches.back() ? " and " : ", ") + user;
    throw catalog::UsageError(option + " is for the bench " + names + ", not for '" + bench + "'; leave it out");
  }
}

/// The options; or, where the command line ends here (--help, or an error), the exit status.
std::variant<Options, ExitStatus> parse_options(int argc, char** argv) {
  Options options;
  CLI::App app(kHelp, "talus bench");
  app.add_option("NAME", options.bench, "bench to run");
  app.add_option("--case", options.only_case, "this case alone");
  app.add_option("--json", options.json, "file for the figures, one JSON object a line");
  app.add_option("--out", options.out, "folder for table, plots and, without --json, the figures");
  add_number_list(app, "--threads", options.threads, {1, kMostThreads},
                  "thread counts to compare, such as 1,2; default: the engine's own choice");
  app.add_option("--catalog", options.catalogue, "shape catalogue, for the benches levels and parts");
  app.add_option("--scans", options.scans, "folder of scans, for the benches decomposition, digitize and micrographs");
  add_whole_number(app, "--seeds", options.seeds, {1, 1000}, "searches of each level, for the bench decomposition");
  app.add_flag("--resume", options.resumes, "measure only the cases that an earlier run with this --json has not");
  app.add_flag("--list", options.is_list, "name the benches and their cases");
  app.set_version_flag("--version", tool_version());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ended_status(app, error);
  }
  if (!options.is_list && options.bench.empty())
    throw catalog::UsageError("no NAME; talus bench --list names the benches");
  if (!options.is_list) refuse_options_of_others(app, options.bench);
  if (app.count("--case") > 0 && options.only_case.empty())
    throw catalog::UsageError("--case is empty; leave it out for all cases, talus bench --list names them");
  if (app.count("--json") > 0 && (!options.json.has_filename() || fs::is_directory(options.json)))
    throw catalog::UsageError("--json \"" + options.json.string() + "\" is a folder, expected a file; --out takes one");
  if (!options.json.empty() && options.out.empty()) options.out = fs::absolute(options.json).parent_path();
  if (options.json.empty() && !options.out.empty()) options.json = options.out / (options.bench + ".json");
  if (options.resumes && options.json.empty())
    throw catalog::UsageError("--resume needs the --json FILE (or --out) of the run that was stopped");
  return options;
}

BenchOptions bench_options(const Options& options) {
  return {options.threads, options.catalogue, options.scans, options.seeds};
}

int list_benches(const Options& options) {
  for (const Bench& bench : benches()) {
    std::printf("%s: %s\n ", bench.name.c_str(), bench.summary.c_str());
    for (const BenchCase& bench_case : bench.plan(bench_options(options)).cases)
      std::printf(" %s", bench_case.name.c_str());
    std::printf("\n");
  }
  return kDone;
}

std::vector<BenchCase> chosen_cases(const BenchPlan& plan, const Options& options) {
  if (options.only_case.empty()) {
    std::vector<BenchCase> chosen;
    std::copy_if(plan.cases.begin(), plan.cases.end(), std::back_inserter(chosen),
                 [](const BenchCase& bench_case) { return !bench_case.is_apart; });
    return chosen;
  }
  std::vector<std::string> known;
  for (const BenchCase& bench_case : plan.cases) {
    if (bench_case.name == options.only_case) return {bench_case};
    known.push_back(bench_case.name);
  }
  throw catalog::UsageError("bench '" + options.bench + "' has no case '" + options.only_case + "'; " +
                            catalog::word_hint(options.only_case, known));
}

std::string command_of(const Options& options, const BenchCase& bench_case) {
  std::string command = "talus bench " + options.bench + " --case " + bench_case.name;
  if (!options.catalogue.empty()) command += " --catalog " + options.catalogue.string();
  if (!options.scans.empty()) command += " --scans DIR";  // results are shared between machines
  if (options.seeds != Options{}.seeds) command += " --seeds " + std::to_string(options.seeds);
  for (std::size_t i = 0; i < options.threads.size(); ++i)
    command += (i ? "," : " --threads ") + std::to_string(options.threads[i]);
  return command;
}

struct Measured {
  std::vector<ReportedFigure> figures;
  std::vector<PlotCurve> curves;
};

/// Where the case is kept; empty if nothing is written.
fs::path case_file(const Options& options, const BenchCase& bench_case) {
  if (options.json.empty()) return {};
  std::string name = bench_case.name;
  std::replace(name.begin(), name.end(), '/', '_');
  return fs::path(options.json.string() + ".cases") / (name + ".json");
}

/// What a case that is kept must have been measured with.
std::string made_with(const Options& options, const BenchCase& bench_case) {
  std::string text = tool_version() + ": " + command_of(options, bench_case);
  if (!bench_case.inputs.empty())
    text += ", " + bench_case.inputs;
  else if (!options.catalogue.empty())
    text += ", catalogue " + catalog::sha256_of_file(options.catalogue);
  if (!options.scans.empty()) text += ", scans in " + fs::absolute(options.scans).lexically_normal().string();
  return text;
}

CaseResult measure_or_keep(const BenchCase& bench_case, const Options& options) {
  const fs::path file = case_file(options, bench_case);
  if (file.empty()) return bench_case.measure();
  const std::string with = made_with(options, bench_case);
  if (options.resumes)
    if (std::optional<CaseResult> kept = read_case(file, with)) return std::move(*kept);
  CaseResult result = bench_case.measure();
  write_case(file, with, result);
  return result;
}

/// The folders that results go to, before hours are spent on them.
void make_folders(const Options& options) {
  if (options.json.empty()) return;
  for (const fs::path& folder :
       {options.out, fs::absolute(options.json).parent_path(), fs::path(options.json.string() + ".cases")}) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
      throw catalog::InputError(folder.string() + ": is no folder and cannot be made one (" +
                                (error ? error.message() : "a file has its name") + "); give another --json or --out");
  }
}

/// Adds a curve, or goes on with the one of the same plot and label.
void add_curve(std::vector<PlotCurve>& curves, PlotCurve next) {
  const auto known = std::find_if(curves.begin(), curves.end(), [&](const PlotCurve& curve) {
    return curve.plot == next.plot && curve.label == next.label && curve.is_reference == next.is_reference;
  });
  if (known == curves.end()) {
    curves.push_back(std::move(next));
    return;
  }
  known->x.insert(known->x.end(), next.x.begin(), next.x.end());
  known->y.insert(known->y.end(), next.y.begin(), next.y.end());
  known->point_names.insert(known->point_names.end(), next.point_names.begin(), next.point_names.end());
}

Measured measure(const std::vector<BenchCase>& cases, const Options& options) {
  Measured measured;
  BatchProgress progress("bench " + options.bench, static_cast<int>(cases.size()));
  for (const BenchCase& bench_case : cases) {
    progress.step(bench_case.name);
    CaseResult result = measure_or_keep(bench_case, options);
    for (Figure& figure : result.figures)
      measured.figures.push_back({options.bench, bench_case.name, std::move(figure), command_of(options, bench_case)});
    for (PlotCurve& curve : result.curves) add_curve(measured.curves, std::move(curve));
  }
  progress.finish();
  return measured;
}

void write_files(const Bench& bench, const BenchPlan& plan, const Measured& measured, const Options& options) {
  const std::string stem = options.json.stem().string();
  write_whole(options.json, json_lines(measured.figures));
  std::string page = plan.page ? plan.page(measured.figures)
                               : markdown_table("talus bench " + bench.name + ": " + bench.summary, measured.figures);
  for (const PlotAxes& axes : plan.plots) {
    const auto is_drawn = [&](const PlotCurve& curve) { return curve.plot == axes.name; };
    if (std::none_of(measured.curves.begin(), measured.curves.end(), is_drawn)) continue;  // its cases were not run
    const std::string plot = stem + "_" + axes.name + ".svg";
    write_whole(options.out / plot, log_plot_svg(axes, measured.curves));
    if (plan.page) page += "\n![" + axes.title + "](" + plot + ")\n";
  }
  write_whole(options.out / (stem + ".md"), page);
}

int run_bench(const Options& options) {
  const Bench& bench = bench_named(options.bench);
  const BenchPlan plan = bench.plan(bench_options(options));
  if (!plan.lacks.empty()) throw catalog::UsageError("bench " + options.bench + ": " + plan.lacks);
  const std::vector<BenchCase> cases = chosen_cases(plan, options);
  make_folders(options);
  const Measured measured = measure(cases, options);
  std::fputs((plan.page ? plan.page(measured.figures) : text_table(measured.figures)).c_str(), stdout);
  if (!options.json.empty()) write_files(bench, plan, measured, options);
  for (const ReportedFigure& reported : measured.figures)
    if (!reported.figure.value || is_goal_met(reported.figure) == false) return kCheckNotPassed;
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage("bench", [&]() -> int {
    const auto parsed = parse_options(argc, argv);
    if (const auto* status = std::get_if<ExitStatus>(&parsed)) return *status;
    const Options& options = std::get<Options>(parsed);
    return options.is_list ? list_benches(options) : run_bench(options);
  });
}
