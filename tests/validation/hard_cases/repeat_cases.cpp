// SPDX-License-Identifier: Apache-2.0
// The same bytes: twice, on any number of threads, broken anywhere.
#include <random>

#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/threads.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::Simulation;

constexpr int kSteps = 5000;  // past the opening of the gate

/// Every byte of the state.
std::string state_of(const Simulation& simulation) {
  const TemporaryFolder folder;
  simulation.write_checkpoint(folder.path());
  return read_bytes(folder / "checkpoint.h5");
}

std::string end_of(int threads) {
  const ThreadLimit limit(threads);
  Simulation simulation(mixed_scene());
  simulation.advance(kSteps);
  return state_of(simulation);
}

Finding threads() {
  const std::string one = end_of(1);
  const bool again = one == end_of(1), two = one == end_of(2), four = one == end_of(4);
  return {again && two && four, text("again %s, 2 threads %s, 4 threads %s", again ? "same" : "other",
                                     two ? "same" : "other", four ? "same" : "other")};
}

Finding resumed() {
  Simulation unbroken(mixed_scene());
  unbroken.advance(kSteps);
  const std::string expected = state_of(unbroken);
  std::mt19937 random(8);
  int same = 0;
  constexpr int kBreaks = 6;
  const TemporaryFolder folder;
  for (int i = 0; i < kBreaks; ++i) {
    const int at = std::uniform_int_distribution<int>(1, kSteps - 1)(random);
    Simulation first(mixed_scene());
    first.advance(at);
    first.ledger();
    first.quality();
    first.write_checkpoint(folder.path());
    Simulation second(mixed_scene());
    second.read_checkpoint(folder.path());
    second.advance(kSteps - at);
    same += state_of(second) == expected;
  }
  return {same == kBreaks, text("%d of %d runs broken at random steps end with the same bytes", same, kBreaks)};
}

}  // namespace

std::vector<HardCase> repeat_cases() {
  return {{"twice, and on 1, 2 and 4 threads", "one state, byte by byte", true, threads},
          {"resumed from a random step", "one state, byte by byte", true, resumed}};
}

}  // namespace hard_cases
