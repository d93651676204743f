// SPDX-License-Identifier: Apache-2.0
// talus-simulate killed at random moments.
#include "tests/validation/hard_cases/hard_case.h"

#ifdef TALUS_SIMULATE
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <thread>

#include "tests/support/scene_text.h"
#include "tests/support/temporary_folder.h"
#endif

namespace hard_cases {

#ifndef TALUS_SIMULATE

std::vector<HardCase> kill_cases() { return {}; }

#else
namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using test_support::with;

/// Another one than this build's where the environment names it: in a folder that went to another machine.
std::string simulate_program() {
  const char* const elsewhere = std::getenv("TALUS_SIMULATE");
  return elsewhere != nullptr ? elsewhere : TALUS_SIMULATE;
}

pid_t start(std::vector<std::string> arguments, const fs::path& output) {
  arguments.insert(arguments.begin(), simulate_program());
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t process = 0;
  const int failed = posix_spawn(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + arguments[0]);
  return process;
}

/// Exit status; -1 if a signal ended it.
int status_of(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Rows without their last column, the speed of the computer.
std::string without_last_column(const std::string& csv) {
  std::string kept;
  for (std::size_t at = 0, end; (end = csv.find('\n', at)) != std::string::npos; at = end + 1) {
    const std::string line = csv.substr(at, end - at);
    kept += line.substr(0, line.rfind(',')) + "\n";
  }
  return kept;
}

/// Everything a run leaves that is a function of its scene.
std::string results_of(const fs::path& run) {
  std::string bytes = without_last_column(read_bytes(run / "time_series.csv")) + read_bytes(run / "walls.csv") +
                      read_bytes(run / "ledger.csv") + read_bytes(run / "checkpoint.h5") +
                      read_bytes(run / "geometry.h5");
  std::vector<fs::path> snapshots;
  for (const auto& entry : fs::directory_iterator(run / "snapshots")) snapshots.push_back(entry.path());
  std::sort(snapshots.begin(), snapshots.end());
  for (const fs::path& file : snapshots) bytes += file.filename().string() + read_bytes(file);
  return bytes;
}

/// A drum with its checkpoints off the grid of snapshots and of the series. The first run ends unbroken; the second is
/// killed and resumed until it ends, and again until it was killed `kills` times.
Finding killed(int kills) {
  const TemporaryFolder folder;
  std::string scene = with(test_support::drum_scene(), "end_time = \"40 ms\"", "end_time = \"300 ms\"");
  scene = with(scene, "checkpoint_every = \"20 ms\"", "checkpoint_every = \"7.3 ms\"");
  test_support::write_bytes(folder / "drum.toml", scene);
  const std::string file = (folder / "drum.toml").string();
  const fs::path whole = folder / "whole", broken = folder / "broken", output = folder / "out.txt";
  const auto before = std::chrono::steady_clock::now();
  if (status_of(start({file, "--out", whole.string(), "--threads", "1"}, output)) != 0)
    return {false, "the unbroken run failed: " + read_bytes(output)};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  const std::string expected = results_of(whole);

  std::mt19937 random(11);
  std::uniform_real_distribution<double> moment(0, 0.5 * seconds);
  int killed = 0, runs = 0, same = 0;
  while (killed < kills) {
    fs::remove_all(broken);
    for (;;) {
      const bool has_begun = fs::exists(broken / "scene.toml");
      if (!has_begun) fs::remove_all(broken);  // killed before it counted as a run
      const std::vector<std::string> arguments =
          has_begun ? std::vector<std::string>{"--resume", broken.string(), "--threads", "1"}
                    : std::vector<std::string>{file, "--out", broken.string(), "--threads", "1"};
      const pid_t process = start(arguments, output);
      if (killed < kills) {
        std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
        kill(process, SIGKILL);
      }
      const int status = status_of(process);
      if (status == 0) break;
      if (status != -1) return {false, text("after %d kills: status %d, ", killed, status) + read_bytes(output)};
      ++killed;
    }
    ++runs;
    same += results_of(broken) == expected;
  }
  return {same == runs, text("%d kills over %d runs: %d end with the bytes of the unbroken one", killed, runs, same)};
}

}  // namespace

std::vector<HardCase> kill_cases() {
  return {{"killed at 8 random moments", "resumes each time, ends with the same bytes", true, [] { return killed(8); }},
          {"killed at 200 random moments", "resumes each time, ends with the same bytes", false,
           [] { return killed(200); }}};
}

#endif

}  // namespace hard_cases
