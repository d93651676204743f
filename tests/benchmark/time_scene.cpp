// SPDX-License-Identifier: Apache-2.0
// One scene for profiling and quick comparisons: settles, then times windows. All figures: talus bench speed.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/settling.h"
#include "tests/benchmark/scenes/speed_scenes.h"
#include "tests/benchmark/scenes/tiled_bed.h"

namespace {

using benchmark_scenes::SceneOptions;

constexpr char kUsage[] =
    "usage: time_scene NAME [--law depth|volume] [--bodies N] [--overlap SHARE] [--steps-per-contact N] [--ledger]\n"
    "                  [--settle SECONDS | --settled [--tiles N]] [--window SECONDS] [--windows N] [--keep FOLDER]\n"
    "                  [--blocks none|launched|captured]\n"
    "NAME: s1-box s1-drum s2 s3 s4 hopper-4 hopper-8 mill-4 mill-8\n"
    "--settled: from where talus bench speed starts its windows, after 500 steps, instead of settling at full "
    "accuracy\n"
    "--tiles: N x N settled boxes side by side (s1-box, s2, s3)\n"
    "--blocks: how steps reach the device, instead of the back end's own way\n"
    "--keep: settle once; later runs go on from the checkpoint in FOLDER\n";

struct Options {
  std::string scene;
  SceneOptions of_scene;
  double settle = -1;  // [s]; negative: the scene's own
  double window = benchmark_scenes::kWindow;
  int windows = benchmark_scenes::kWindows;
  bool is_settled = false;
  int tiles = 1;
  std::filesystem::path keep;
  std::optional<dem_gpu::StepBlocks> blocks;
};

double number(const std::string& name, const std::string& value) {
  std::size_t end = 0;
  double found = 0;
  try {
    found = std::stod(value, &end);
  } catch (const std::logic_error&) {
    end = 0;
  }
  if (end == 0 || end != value.size() || !(found >= 0))
    throw std::invalid_argument(name + " takes a number of 0 or more, not '" + value + "'");
  return found;
}

int count(const std::string& name, const std::string& value) {
  const double found = number(name, value);
  if (found != std::floor(found) || found > std::numeric_limits<int>::max())
    throw std::invalid_argument(name + " takes a whole number, not '" + value + "'");
  return static_cast<int>(found);
}

benchmark_scenes::Law law(const std::string& value) {
  if (value == "volume") return benchmark_scenes::Law::overlap_volume;
  if (value == "depth") return benchmark_scenes::Law::depth_potential;
  throw std::invalid_argument("--law takes depth or volume, not '" + value + "'");
}

dem_gpu::StepBlocks step_blocks(const std::string& value) {
  if (value == "none") return dem_gpu::StepBlocks::none;
  if (value == "launched") return dem_gpu::StepBlocks::launched;
  if (value == "captured") return dem_gpu::StepBlocks::captured;
  throw std::invalid_argument("--blocks takes none, launched or captured, not '" + value + "'");
}

Options parsed(int argc, char** argv) {
  if (argc < 2) throw std::invalid_argument("no NAME");
  Options options;
  options.scene = argv[1];
  for (int i = 2; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--ledger") {
      options.of_scene.has_ledger = true;
      continue;
    }
    if (name == "--settled") {
      options.is_settled = true;
      continue;
    }
    if (++i == argc) throw std::invalid_argument(name + " needs a value");
    const std::string value = argv[i];
    if (name == "--law")
      options.of_scene.law = law(value);
    else if (name == "--bodies")
      options.of_scene.bodies = count(name, value);
    else if (name == "--overlap")
      options.of_scene.flat_overlap = number(name, value);
    else if (name == "--steps-per-contact")
      options.of_scene.steps_per_contact = number(name, value);
    else if (name == "--settle")
      options.settle = number(name, value);
    else if (name == "--window")
      options.window = number(name, value);
    else if (name == "--windows")
      options.windows = count(name, value);
    else if (name == "--tiles")
      options.tiles = count(name, value);
    else if (name == "--keep")
      options.keep = value;
    else if (name == "--blocks")
      options.blocks = step_blocks(value);
    else
      throw std::invalid_argument("unknown option " + name);
  }
  if (options.tiles != 1 && (!options.is_settled || options.of_scene.bodies > 0))
    throw std::invalid_argument("--tiles goes with --settled and without --bodies");
  return options;
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void settle(dem_gpu::Simulation& simulation, double time, const std::filesystem::path& keep) {
  if (!keep.empty() && std::filesystem::exists(keep / "checkpoint.h5")) {
    simulation.read_checkpoint(keep);
    return;
  }
  const double start = seconds_now();
  const auto steps = static_cast<std::int64_t>(std::llround(time / simulation.time_step()));
  simulation.advance(steps);
  if (steps > 0)
    std::printf("settled in %lld steps, %.4f ms each\n", static_cast<long long>(steps),
                1e3 * (seconds_now() - start) / static_cast<double>(steps));
  if (keep.empty()) return;
  std::filesystem::create_directories(keep);
  simulation.write_checkpoint(keep);
}

/// Root mean square over the bodies that are there.
double root_mean_square(const dem_gpu::Snapshot& snapshot, const std::vector<dem_gpu::Vec3>& vectors) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (snapshot.active[i]) {
      sum += norm_squared(vectors[i]);
      ++count;
    }
  return std::sqrt(sum / std::max(count, 1));
}

void print_state(const dem_gpu::Simulation& simulation) {
  const dem_gpu::BulkState bulk = simulation.bulk();
  const dem_gpu::RunQuality quality = simulation.quality();
  double height = 0;
  int of_pairs = 0;
  const dem_gpu::Snapshot snapshot = simulation.snapshot();
  for (const auto& contact : snapshot.contacts) of_pairs += contact.body_b >= 0;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i)
    if (snapshot.active[i]) height += snapshot.position[i].z / bulk.active_bodies;
  std::printf("time %.4f s, %d bodies, %d contacts (%.3f bodies touch one), mean height %.5f m, %lld list rebuilds\n",
              simulation.time(), bulk.active_bodies, bulk.contacts, 2.0 * of_pairs / bulk.active_bodies, height,
              static_cast<long long>(quality.list_rebuilds));
  std::printf("root mean square speed %.3g m/s, spin %.3g rad/s\n", root_mean_square(snapshot, snapshot.velocity),
              root_mean_square(snapshot, snapshot.angular_velocity));
  std::printf("largest overlap %.4f of the diameter, fewest steps in a contact %.1f\n", quality.largest_overlap,
              quality.smallest_steps_per_contact);
  if (const dem_gpu::StepCounts counts = simulation.step_counts(); counts.in_blocks > 0)
    std::printf("%lld steps by themselves, %lld in blocks, %lld halts, %lld replays\n",
                static_cast<long long>(counts.by_themselves), static_cast<long long>(counts.in_blocks),
                static_cast<long long>(counts.halts), static_cast<long long>(counts.replays));
  if (const dem_gpu::EnergyLedger ledger = simulation.ledger(); ledger.throughput > 0)
    std::printf("energy imbalance %.3g of what was put in\n", ledger.imbalance() / ledger.throughput);
}

/// As the options say, bodies where they begin.
dem_gpu::Scene scene_to_time(const Options& options, const benchmark_scenes::SpeedScene& chosen) {
  if (!options.is_settled) return chosen.make(options.of_scene);
  const dem_gpu::Snapshot settled = benchmark_scenes::settle(chosen, options.of_scene.bodies).settled;
  if (options.tiles == 1) return benchmark_scenes::resumed(chosen.make(options.of_scene), settled);
  const dem_gpu::Snapshot bed = benchmark_scenes::tiled(chosen, settled, options.tiles);
  SceneOptions wide = options.of_scene;
  wide.bodies = static_cast<int>(bed.position.size());
  return benchmark_scenes::resumed(chosen.make(wide), bed);
}

void time_scene(const Options& options) {
  const benchmark_scenes::SpeedScene& chosen = benchmark_scenes::speed_scene(options.scene);
  dem_gpu::Simulation simulation(scene_to_time(options, chosen));
  if (options.blocks) simulation.set_step_blocks(*options.blocks);
  std::printf("%d bodies begin\n%s: time step %.4g s\n", simulation.bulk().active_bodies, options.scene.c_str(),
              simulation.time_step());
  if (options.is_settled)
    simulation.advance(benchmark_scenes::kResettlingSteps);
  else
    settle(simulation, options.settle < 0 ? chosen.settling_time : options.settle, options.keep);
  const auto steps =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(options.window / simulation.time_step())));
  for (int w = 0; w < options.windows; ++w) {
    const double start = seconds_now(), cpu_start = cpu_seconds();
    simulation.advance(steps);
    std::printf("%lld steps, %.4f ms each, %.4f ms of processors\n", static_cast<long long>(steps),
                1e3 * (seconds_now() - start) / static_cast<double>(steps),
                1e3 * (cpu_seconds() - cpu_start) / static_cast<double>(steps));
  }
  print_state(simulation);
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  try {
    time_scene(parsed(argc, argv));
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "time_scene: %s\n%s", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "time_scene: %s\n", error.what());
    return 1;
  }
  return 0;
}
