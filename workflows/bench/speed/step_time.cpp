// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/speed/step_time.h"

#include <malloc.h>

#include <algorithm>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "workflows/bench/cpu_clock.h"
#include "workflows/thread_count.h"

namespace workflows {
namespace {

bool is_on_cpu() { return std::string(backend_name()) != "CUDA"; }
bool has_choice_of_threads() { return std::string(backend_name()) == "OMP" || std::string(backend_name()) == "TBB"; }

template <class Clock>
double window_time(dem_gpu::Simulation& simulation, int steps) {
  const Clock clock;
  simulation.advance(steps);
  return 1e3 * clock.seconds() / steps;
}

}  // namespace

StepTimes time_steps(dem_gpu::Simulation& simulation, int windows, int steps) {
  std::vector<double> times;
  for (int w = 0; w < windows; ++w)
    times.push_back(is_on_cpu() ? window_time<CpuClock>(simulation, steps) : window_time<WallClock>(simulation, steps));
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.front(), times.back()};
}

double two_thread_speed_up(dem_gpu::Simulation& simulation, int windows, int steps) {
  double fastest[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  for (int w = 0; w < windows; ++w)
    for (const int threads : {1, 2}) {
      set_thread_count(threads);
      double& time = fastest[threads - 1];
      time = std::min(time, window_time<WallClock>(simulation, steps));
    }
  set_thread_count(1);
  return fastest[0] / fastest[1];
}

bool has_two_threads() { return has_choice_of_threads() && std::thread::hardware_concurrency() >= 2; }

void on_all_threads(const std::function<void()>& work) {
  if (!has_two_threads()) return work();
  set_thread_count(static_cast<int>(std::thread::hardware_concurrency()));
  work();
  set_thread_count(1);
}

std::size_t allocated_bytes() {
  const struct mallinfo2 allocated = mallinfo2();
  return allocated.uordblks + allocated.hblkhd;
}

}  // namespace workflows
