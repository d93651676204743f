// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "workflows/atomic_file.h"
#include "workflows/command_options.h"
#include "workflows/idle_settings.h"
#include "workflows/resolved_scene.h"
#include "workflows/run_loop.h"
#include "workflows/run_promises.h"
#include "workflows/run_reports.h"
#include "workflows/scene_place.h"
#include "workflows/stage_tool.h"
#include "workflows/thread_count.h"
#include "workflows/units.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp = R"(Example: talus simulate hopper.toml

Runs the DEM scene of a TOML file and leaves a run folder: snapshots, checkpoints, time series, run.json.

  talus simulate hopper.toml --dry-run         what would be run, and how many steps
  talus simulate --resume runs/hopper          go on from the last checkpoint
  talus simulate mill.toml --out runs/mill_b   into a folder of your choice

TERM and USR1 write a checkpoint and exit with 75, INT (Ctrl-C) with 130; both resumable.)";

struct SimulateOptions {
  fs::path scene;
  fs::path out;
  bool is_resumed = false;
  fs::path resumed_folder;         // may be empty: the scene's own folder
  std::optional<double> end_time;  // [s]
  bool dry_run = false;
  int threads = 0;  // 0: all
  bool json = false;
  std::string command;
};

/// The options; or, where the command line ends here (--help, or an error), the exit status.
std::variant<SimulateOptions, ExitStatus> parse_options(int argc, char** argv) {
  SimulateOptions options;
  std::string end_time, resumed;
  CLI::App app(kHelp, "talus simulate");
  app.add_option("SCENE", options.scene, "scene file (TOML)");
  app.add_option("--out", options.out, "run folder; default: runs/NAME beside the scene file");
  CLI::Option* resume =
      app.add_option("--resume", resumed, "run folder to go on with; default: the scene's own")->expected(0, 1);
  app.add_option("--end-time", end_time, "simulated time to stop at, such as \"2 s\"; instead of the scene's");
  app.add_flag("--dry-run", options.dry_run, "say what would be run; write nothing");
  app.add_option("--threads", options.threads, "threads of the engine; default: all")
      ->check(CLI::Range(1, kMostThreads));
  app.add_flag("--json", options.json, "print run.json (with --dry-run the resolved scene) on stdout");
  app.set_version_flag("--version", tool_version());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ended_status(app, error);
  }
  options.is_resumed = resume->count() > 0;
  options.resumed_folder = resumed;
  if (!options.is_resumed && options.scene.empty()) throw catalog::UsageError("no SCENE; see talus simulate --help");
  if (options.is_resumed && options.scene.empty() && resumed.empty())
    throw catalog::UsageError("--resume needs the run folder, or SCENE to find it by");
  if (options.is_resumed && !options.out.empty())
    throw catalog::UsageError("--resume goes on in its own folder; leave --out out");
  if (!end_time.empty()) {
    options.end_time = parse_quantity(end_time, Dimension::time);
    if (!options.end_time || !(*options.end_time > 0))
      throw catalog::UsageError("--end-time \"" + end_time + "\" is " +
                                (options.end_time ? "not above 0" : "not a time") +
                                "; expected text such as \"2 s\" (units: " + accepted_units(Dimension::time) + ")");
  }
  for (int i = 0; i < argc; ++i) options.command += (i ? " " : "") + std::string(argv[i]);
  return options;
}

fs::path default_folder(const SceneDescription& description) {
  return description.file.parent_path() / "runs" / description.scene.name;
}

/// The scene of a run that is resumed: from its own copy, which the scene file, if given, must equal.
SceneDescription read_resumed_scene(const SimulateOptions& options, RunFolder& folder) {
  folder.require_run();
  if (!options.dry_run) folder.lock();
  const nlohmann::ordered_json resolved = folder.read_json("resolved_scene.json");
  if (!options.scene.empty() && read_whole(options.scene) != read_whole(folder.scene_file()))
    throw catalog::InputError(options.scene.string() + ": differs from the scene that " + folder.path().string() +
                              " was run with; resume with that folder alone, or start a new run with another --out");
  try {
    SceneDescription description =
        read_scene(folder.scene_file(), fs::path(resolved.at("scene_folder").get<std::string>()));
    description.scene.name = resolved.at("name").get<std::string>();
    description.scene.run.end_time = resolved.at("run").at("end_time").get<double>();
    return description;
  } catch (const nlohmann::json::exception&) {
    throw catalog::InputError(
        (folder.path() / "resolved_scene.json").string() +
        ": missing or damaged (expected scene_folder, name and run.end_time), so the run cannot be resumed; start it "
        "again with another --out");
  }
}

void print_dry_run(const AssembledScene& assembled, const SceneDescription& description,
                   const nlohmann::ordered_json& resolved, bool json) {
  if (json)
    std::printf("%s\n", resolved.dump(2).c_str());
  else
    std::printf("%s%s", scene_table(assembled).c_str(), size_table(assembled, description).c_str());
}

/// A run resumed with another end keeps it for the next time.
void keep_end_time(const RunFolder& folder, double end_time) {
  nlohmann::ordered_json resolved = folder.read_json("resolved_scene.json");
  if (resolved["run"]["end_time"] == end_time) return;
  resolved["run"]["end_time"] = end_time;
  folder.write_json("resolved_scene.json", resolved);
}

void start_log(const RunFolder& folder, const dem_gpu::Simulation& simulation, const SimulateOptions& options) {
  folder.log(tool_version() + ", engine on " + backend_name() + " in " + dem_gpu::kPrecision +
             " precision: " + options.command);
  std::string passes;
  for (const std::string& pass : simulation.pass_names()) passes += (passes.empty() ? "" : ", ") + pass;
  folder.log("passes: " + passes);
}

double earlier_wall_seconds(const RunFolder& folder) {
  const nlohmann::ordered_json summary = folder.read_json("run.json");
  return summary.contains("wall_seconds") && summary["wall_seconds"].is_number() ? summary["wall_seconds"].get<double>()
                                                                                 : 0;
}

/// Takes up the checkpoint; writes nothing unless there is something to run.
void go_on(dem_gpu::Simulation& simulation, const RunFolder& folder, const RunSchedule& schedule) {
  const std::string note = simulation.read_checkpoint(folder.path());
  if (simulation.step() > schedule.end_step) {
    char time[32];
    std::snprintf(time, sizeof time, "%.6g", simulation.time());
    throw catalog::InputError(folder.path().string() + ": is at " + time + " s already; give a later --end-time");
  }
  if (note.empty()) return;
  std::fprintf(stderr, "simulate: %s\n", note.c_str());
  folder.log(note);
}

int simulate(const SimulateOptions& options) {
  if (options.threads > 0) set_thread_count(options.threads);

  // The scene and its folder.
  std::optional<SceneDescription> read;
  if (!options.is_resumed || options.resumed_folder.empty()) read = read_scene(options.scene);
  RunFolder folder(!options.resumed_folder.empty() ? options.resumed_folder
                   : !options.out.empty()          ? options.out
                                                   : default_folder(*read));
  SceneDescription description = options.is_resumed ? read_resumed_scene(options, folder) : std::move(*read);
  if (!options.is_resumed && !options.dry_run) folder.refuse_if_used();
  if (options.end_time) description.scene.run.end_time = *options.end_time;

  // What runs.
  const AssembledScene assembled = assemble_scene(description);
  check_scene(assembled, description);
  const RunSchedule schedule = run_schedule(description, assembled.scene);
  const fs::path scene_folder = fs::absolute(description.file).lexically_normal().parent_path();
  const nlohmann::ordered_json resolved = resolved_scene(assembled, description, scene_folder.string());
  if (options.dry_run) {
    for (const std::string& warning : idle_settings(description, assembled.scene))
      std::fprintf(stderr, "simulate: warning: %s\n", warning.c_str());
    print_dry_run(assembled, description, resolved, options.json);
    return kDone;
  }

  // Run it.
  catch_stop_signals();
  dem_gpu::Simulation simulation = start_simulation(assembled, description);
  RunPlan plan{description, assembled, folder, options.command};
  bool from_checkpoint = false;
  std::vector<std::string> warnings;
  if (options.is_resumed) {
    plan.earlier_wall_seconds = earlier_wall_seconds(folder);
    from_checkpoint = folder.has_checkpoint();
    if (from_checkpoint)
      go_on(simulation, folder, schedule);
    else
      std::fprintf(stderr, "simulate: %s has no checkpoint yet; it starts again from time 0\n", folder.path().c_str());
    keep_end_time(folder, assembled.scene.run.end_time);
    warnings =
        folder.mend(simulation.geometry(), from_checkpoint ? schedule.snapshots.last_index(simulation.step()) : -1);
  } else {
    folder.start(description, resolved, simulation.geometry());
  }
  start_log(folder, simulation, options);
  for (const std::string& idle : idle_settings(description, assembled.scene)) warnings.push_back(idle);
  if (const auto warning = start_warning(assembled.scene)) warnings.push_back(*warning);
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "simulate: warning: %s\n", warning.c_str());
    folder.log("warning: " + warning);
  }
  std::fprintf(stderr, "%s%s", scene_table(assembled).c_str(), size_table(assembled, description).c_str());
  const ExitStatus status = run_to_end(simulation, plan, from_checkpoint);
  if (options.json)
    std::printf("%s\n", folder.read_json("run.json").dump(2).c_str());
  else
    std::printf("%s\n", folder.path().c_str());
  return status;
}

}  // namespace
}  // namespace workflows

int main(int argc, char** argv) {
  using namespace workflows;
  return run_stage("simulate", [&]() -> int {
    const auto parsed = parse_options(argc, argv);
    if (const auto* status = std::get_if<ExitStatus>(&parsed)) return *status;
    return simulate(std::get<SimulateOptions>(parsed));
  });
}
