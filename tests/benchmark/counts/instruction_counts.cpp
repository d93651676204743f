// SPDX-License-Identifier: Apache-2.0
// Instructions that a particle takes in a step, counted by callgrind: the same on a busy machine as on an idle one.
//   instruction_counts --check FILE    small scenes against the counts recorded in FILE
//   instruction_counts --record FILE   writes them there
//   instruction_counts --whole         the scenes at their own size, and LIGGGHTS on S1 where it is installed
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "catalog/input_error.h"
#include "tests/benchmark/counts/callgrind.h"
#include "tests/benchmark/counts/counted_run.h"
#include "tests/benchmark/scenes/peer_files.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"

namespace {

namespace fs = std::filesystem;
using namespace benchmark_counts;
using Json = nlohmann::ordered_json;
using Counts = std::map<std::string, double>;  // instructions a particle and step

constexpr double kTolerance = 0.05;
constexpr int kSkipped = 77;  // the test's SKIP_RETURN_CODE

/// Counts depend on it.
const std::string kCompiler = TALUS_COMPILER;

/// A folder of one's own that is removed at the end.
class WorkFolder {
 public:
  WorkFolder() : path_(fs::temp_directory_path() / ("talus_counts_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double count(const CountedRun& run, const fs::path& folder) {
  settle_into(folder, run);
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  return instructions_of({self, "--step", run.name, folder.string()}, false, folder) / run.steps / run.bodies;
}

Counts count_all(const std::vector<CountedRun>& runs) {
  const WorkFolder folder;
  Counts counts;
  for (const CountedRun& run : runs) {
    counts[run.name] = count(run, folder.path());
    std::printf("%-16s %10.1f instructions a particle and step\n", run.name.c_str(), counts[run.name]);
    std::fflush(stdout);
  }
  return counts;
}

/// LIGGGHTS on the settled box: what more steps take more.
void count_liggghts() {
  if (std::system("command -v liggghts > /dev/null") != 0) {
    std::printf("LIGGGHTS is not installed here\n");
    return;
  }
  const WorkFolder folder;
  const CountedRun& run = counted_run("s1-box");
  settle_into(folder.path(), run);
  const benchmark_scenes::SpeedScene& scene = benchmark_scenes::speed_scene(run.scene);
  const fs::path particles = folder.path() / "particles.data";
  std::ofstream(particles) << benchmark_scenes::lammps_particles(benchmark_scenes::resumed(
      scene.make({}), dem_gpu::read_snapshot(folder.path() / (run.scene + "_" + std::to_string(run.bodies) + ".h5"))));
  const auto count_of = [&](int steps) {
    return instructions_of(
        {"liggghts", "-in", std::string(TALUS_PEER_SCRIPTS) + "/s1_box.liggghts", "-log", "none", "-var", "particles",
         particles.string(), "-var", "settle", std::to_string(steps), "-var", "window", "0"},
        true, folder.path());
  };
  constexpr int kSteps = 50;
  const double counted = (count_of(kWarmUpSteps + kSteps) - count_of(kWarmUpSteps)) / kSteps / run.bodies;
  std::printf("%-16s %10.1f instructions a particle and step\n", "s1-box LIGGGHTS", counted);
}

int record(const fs::path& file) {
  Json json;
  json["compiler"] = kCompiler;
  json["instructions a particle and step"] = count_all(guard_runs());
  std::ofstream(file) << json.dump(2) << "\n";
  return 0;
}

/// Whether the count is within the tolerance; says what to do if not.
bool holds(const std::string& name, double counted, double recorded) {
  const double change = counted / recorded - 1;
  if (std::abs(change) <= kTolerance) return true;
  std::printf("%s takes %.1f %% %s instructions than recorded (%.1f). %s\n", name.c_str(), 100 * std::abs(change),
              change > 0 ? "more" : "fewer", recorded,
              change > 0 ? "Find out why (callgrind_annotate); if it is worth it, make record-instruction-counts."
                         : "Well done: make record-instruction-counts, so that it stays so.");
  return false;
}

int check(const fs::path& file) {
  std::ifstream text(file);
  if (!text) throw catalog::InputError(file.string() + " cannot be read; make record-instruction-counts writes it");
  const Json json = Json::parse(text);
  if (json.at("compiler") != kCompiler) {
    std::printf("recorded with %s, this is %s: counts of two compilers are not compared\n",
                json.at("compiler").get<std::string>().c_str(), kCompiler.c_str());
    return kSkipped;
  }
  const Json& recorded = json.at("instructions a particle and step");
  bool all_hold = true;
  for (const auto& [name, counted] : count_all(guard_runs()))
    all_hold = holds(name, counted, recorded.at(name).get<double>()) && all_hold;
  return all_hold ? 0 : 1;
}

int run(const std::vector<std::string>& arguments) {
  const std::string mode = arguments.empty() ? "" : arguments.front();
  if (mode == "--step" && arguments.size() == 3) {
    step_counted(arguments[2], counted_run(arguments[1]));
    return 0;
  }
  if (mode == "--record" && arguments.size() == 2) return record(arguments[1]);
  if (mode == "--check" && arguments.size() == 2) return check(arguments[1]);
  if (mode == "--whole" && arguments.size() == 1) {
    count_all(whole_runs());
    count_liggghts();
    return 0;
  }
  throw catalog::UsageError("usage: instruction_counts --check FILE | --record FILE | --whole");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const catalog::UsageError& error) {
    std::fprintf(stderr, "instruction_counts: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "instruction_counts: %s\n", error.what());
    return 1;
  }
}
