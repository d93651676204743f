// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "dem_gpu/simulation.h"

namespace workflows {

struct StepTimes {
  double median = 0, least = 0, largest = 0;  // of the windows [ms a step]
};

/// Times `windows` windows of `steps` steps each. On the CPU with one thread the thread's own time counts, so that
/// other work on the machine does not; with more threads, or on a GPU, time on the wall.
StepTimes time_steps(dem_gpu::Simulation& simulation, int windows, int steps);

/// Windows of one thread and of two in turn, time on the wall: how many times as fast two are, by the fastest windows.
/// Leaves the engine with one thread.
double two_thread_speed_up(dem_gpu::Simulation& simulation, int windows, int steps);

/// Whether this build and machine can run two threads beside each other.
bool has_two_threads();

/// Does what is not timed on all threads there are; its result does not depend on them. Leaves the engine with one,
/// where it has a choice.
void on_all_threads(const std::function<void()>& work);

/// What the process holds in allocated memory [bytes].
std::size_t allocated_bytes();

}  // namespace workflows
