// SPDX-License-Identifier: Apache-2.0
#include "workflows/run_loop.h"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "catalog/input_error.h"
#include "workflows/run_progress.h"
#include "workflows/run_promises.h"
#include "workflows/run_reports.h"
#include "workflows/series_files.h"

namespace workflows {
namespace {

// Between two looks at signals and the clock.
constexpr double kChunkSeconds = 0.2;

// No run lasts longer: millions of steps a second for a week.
constexpr double kMostSteps = 1e12;

std::string numeral(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

volatile std::sig_atomic_t stop_signal = 0;

extern "C" void remember_stop(int signal) { stop_signal = signal; }

/// The state of one call of run_to_end.
class RunLoop {
 public:
  RunLoop(dem_gpu::Simulation& simulation, const RunPlan& plan, bool is_resumed)
      : simulation_(simulation),
        plan_(plan),
        schedule_(run_schedule(plan.description, plan.assembled.scene)),
        series_(plan.folder.path(), plan.assembled.scene, is_resumed ? simulation.time() : -1),
        progress_(simulation.step()),
        last_row_step_(simulation.step()) {
    plan.folder.remove_snapshots_after(schedule_.snapshot_number(simulation.step()));
    if (!is_resumed) return;
    ledger_ = simulation.ledger();
    const double due =
        double(schedule_.series.step_of(schedule_.series.last_index(simulation.step()))) * simulation.time_step();
    for (const std::string& gap : series_.gaps(due)) {
      std::fprintf(stderr, "simulate: warning: %s\n", gap.c_str());
      plan.folder.log("warning: " + gap);
    }
  }

  ExitStatus run(bool is_resumed) {
    if (!is_resumed) write_outputs();
    write_summary(false, "");
    std::int64_t chunk = 1;
    while (simulation_.step() < schedule_.end_step) {
      if (stop_signal != 0) return stop();
      const std::int64_t steps = std::min(schedule_.steps_to_next(simulation_.step()), chunk);
      const auto before = std::chrono::steady_clock::now();
      simulation_.advance(steps);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
      // Toward chunks of kChunkSeconds; how the steps are cut does not change the result.
      const double ideal = kChunkSeconds * double(steps) / std::max(seconds, 1e-6);
      chunk = std::max<std::int64_t>(1, std::min<std::int64_t>(static_cast<std::int64_t>(ideal), 4 * chunk));
      write_outputs();
      show_progress();
    }
    return finish();
  }

  void fail(const std::string& message) {
    progress_.finish();
    plan_.folder.log("failed: " + message);
    write_summary(false, message);
  }

 private:
  bool is_at_end() const { return simulation_.step() >= schedule_.end_step; }

  /// What is due at this step, the checkpoint last: it stands for everything before it.
  void write_outputs() {
    const std::int64_t step = simulation_.step();
    if (schedule_.series.is_due(step) || is_at_end()) {
      ledger_ = simulation_.ledger();
      const double now = progress_.seconds();
      series_.append(simulation_, ledger_,
                     now > last_row_seconds_ ? double(step - last_row_step_) / (now - last_row_seconds_) : 0);
      last_row_step_ = step;
      last_row_seconds_ = now;
    }
    if (schedule_.snapshots.interval > 0 && (schedule_.snapshots.is_due(step) || is_at_end()))
      plan_.folder.write_snapshot(schedule_.snapshot_number(step), simulation_.snapshot());
    if ((schedule_.checkpoints.is_due(step) && step > 0) || is_at_end()) {
      simulation_.write_checkpoint(plan_.folder.path());
      write_summary(false, "");
    }
  }

  void show_progress() {
    const RunStatus status{simulation_.time(), double(schedule_.end_step) * simulation_.time_step(), simulation_.step(),
                           schedule_.end_step, plan_.assembled.scene.energy_ledger ? imbalance_share(ledger_) : -1};
    if (const std::string line = progress_.show(status); !line.empty()) plan_.folder.log(line);
  }

  void write_summary(bool finished, const std::string& error) {
    const RunFacts facts{finished, plan_.earlier_wall_seconds + progress_.seconds(), plan_.command, error};
    plan_.folder.write_json("run.json", run_summary(plan_.assembled, plan_.description, simulation_, ledger_, facts));
  }

  ExitStatus stop() {
    simulation_.write_checkpoint(plan_.folder.path());
    ledger_ = simulation_.ledger();
    write_summary(false, "");
    progress_.finish();
    char line[96];
    std::snprintf(line, sizeof line, "stopped at %.6g s (step %lld); resumable with ", simulation_.time(),
                  static_cast<long long>(simulation_.step()));
    const std::string message = line + ("talus simulate --resume " + plan_.folder.path().string());
    std::fprintf(stderr, "simulate: %s\n", message.c_str());
    plan_.folder.log(message);
    return stop_signal == SIGINT ? kInterrupted : kResumable;
  }

  ExitStatus finish() {
    ledger_ = simulation_.ledger();
    write_summary(true, "");
    progress_.finish();
    plan_.folder.log(promise_line(plan_.assembled, promises(plan_.assembled, simulation_, ledger_)));
    for (const std::string& warning : run_warnings(plan_.assembled, plan_.description, simulation_, ledger_)) {
      std::fprintf(stderr, "simulate: warning: %s\n", warning.c_str());
      plan_.folder.log("warning: " + warning);
    }
    plan_.folder.log("finished");
    return kDone;
  }

  dem_gpu::Simulation& simulation_;
  const RunPlan& plan_;
  RunSchedule schedule_;
  RunSeries series_;
  RunProgress progress_;
  dem_gpu::EnergyLedger ledger_;  // at the last row of the series
  std::int64_t last_row_step_;
  double last_row_seconds_ = 0;
};

}  // namespace

RunSchedule run_schedule(const SceneDescription& description, const dem_gpu::Scene& scene) {
  const double time_step = dem_gpu::time_step(scene);
  const dem_gpu::RunControl& run = scene.run;
  const auto refuse = [&](const std::string& what) {
    const auto place = description.places.find("run: ");
    throw catalog::InputError((place == description.places.end() ? description.file.string() : place->second) +
                              ": run." + what);
  };
  const double steps = run.end_time / time_step;
  if (!(steps >= 1 && steps <= kMostSteps))
    refuse("end_time of " + numeral(run.end_time) + " s is " + numeral(steps) + " time steps of " + numeral(time_step) +
           " s; state a time of 1 to " + numeral(kMostSteps) + " steps");
  const auto times = [&](const char* key, double interval) {
    if (!(interval / time_step <= kMostSteps))
      refuse(key + (" is longer than " + numeral(kMostSteps)) + " time steps of " + numeral(time_step) +
             " s; state a shorter one");
    if (interval > 0 && interval < time_step)
      refuse(std::string(key) + " is shorter than the time step of " + numeral(time_step) + " s; state a longer one");
    return OutputTimes{interval, time_step};
  };
  RunSchedule schedule;
  schedule.snapshots = times("snapshot_every", run.snapshot_interval);
  schedule.series = times("series_every", run.series_interval > 0 ? run.series_interval : run.snapshot_interval);
  schedule.checkpoints = times("checkpoint_every", run.checkpoint_interval);
  schedule.end_step = std::llround(steps);
  return schedule;
}

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = remember_stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGTERM, SIGUSR1, SIGINT}) sigaction(signal, &action, nullptr);
}

ExitStatus run_to_end(dem_gpu::Simulation& simulation, const RunPlan& plan, bool is_resumed) {
  RunLoop loop(simulation, plan, is_resumed);
  try {
    return loop.run(is_resumed);
  } catch (const std::runtime_error& error) {
    loop.fail(error.what());
    throw;
  }
}

}  // namespace workflows
