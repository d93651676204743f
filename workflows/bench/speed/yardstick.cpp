// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/speed/yardstick.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/benchmark/scenes/peer_files.h"
#include "workflows/atomic_file.h"
#include "workflows/bench/speed/settled_scene.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;

constexpr int kWarmUpSteps = 300, kTimedSteps = 500;
const fs::path kScript = fs::path(TALUS_PEER_SCRIPTS) / "s1_box.liggghts";

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

/// CPU time of a program found on PATH, its output thrown away [s]; nothing if it did not end with status 0.
std::optional<double> cpu_time_of(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return std::nullopt;
  int status = 0;
  struct rusage used {};
  while (wait4(process, &status, 0, &used) < 0)
    if (errno != EINTR) return std::nullopt;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Particles of the settled box in a file that is removed at the end of the process.
class ParticleFile {
 public:
  ParticleFile() : path_(fs::temp_directory_path() / ("talus_s1_" + std::to_string(getpid()) + ".data")) {
    const dem_gpu::Scene scene = scene_at(benchmark_scenes::speed_scene("s1-box"), Moment::settled, {});
    write_whole(path_, benchmark_scenes::lammps_particles(scene));
  }
  ~ParticleFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  std::optional<double> cpu_time(int steps) const {
    return cpu_time_of({"liggghts", "-in", kScript.string(), "-log", "none", "-var", "particles", path_.string(),
                        "-var", "settle", std::to_string(steps), "-var", "window", "0"});
  }

 private:
  fs::path path_;
};

}  // namespace

std::optional<double> liggghts_step_time() {
  static const bool is_there = fs::exists(kScript) && is_on_path("liggghts");
  if (!is_there) return std::nullopt;
  static const ParticleFile particles;
  // Reading the file and coming to rest again are not what is timed.
  static const std::optional<double> warm_up = particles.cpu_time(kWarmUpSteps);
  const std::optional<double> whole = particles.cpu_time(kWarmUpSteps + kTimedSteps);
  if (!warm_up || !whole) {
    std::cerr << "bench speed: liggghts is installed but did not run " << kScript.string()
              << " to its end; no ratios\n";
    return std::nullopt;
  }
  return 1e3 * (*whole - *warm_up) / kTimedSteps;
}

}  // namespace workflows
