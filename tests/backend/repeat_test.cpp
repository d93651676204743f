// SPDX-License-Identifier: Apache-2.0
// The same run gives the same bytes: twice, and on any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/temporary_folder.h"

#if defined(TALUS_BACKEND_TBB)
#include <tbb/global_control.h>
#elif defined(TALUS_BACKEND_OMP)
#include <omp.h>
#endif

namespace {

using namespace test_support;

/// Bytes of the snapshot file and of the ledger after `steps`.
std::string outcome(const dem_gpu::Scene& scene, int steps) {
  const TemporaryFolder folder;
  dem_gpu::Simulation simulation(scene);
  simulation.advance(steps);
  dem_gpu::write_snapshot(folder / "snapshot.h5", simulation.snapshot());
  const auto ledger = simulation.ledger();
  std::string bytes = read_bytes(folder / "snapshot.h5");
  for (const double value : {ledger.kinetic, ledger.elastic_normal, ledger.elastic_tangential, ledger.wall_work,
                             ledger.removed, ledger.dissipated()})
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  return bytes;
}

constexpr int kSteps = 6000;  // past the opening of the gate

TEST(Repeat, TwiceIsTheSame) { EXPECT_EQ(outcome(mixed_scene(), kSteps), outcome(mixed_scene(), kSteps)); }

TEST(Repeat, StateIsTheSameHoweverOftenItIsAsked) {
  dem_gpu::Simulation asked(mixed_scene()), silent(mixed_scene());
  for (int i = 0; i < 20; ++i) {
    asked.advance(kSteps / 20);
    asked.ledger();
    asked.take_wall_loads();
    asked.quality();
    asked.snapshot();
  }
  silent.advance(kSteps);
  const auto a = asked.snapshot(), b = silent.snapshot();
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.orientation, b.orientation);
  EXPECT_NEAR(asked.ledger().dissipated(), silent.ledger().dissipated(), 1e-12 * silent.ledger().throughput);
}

TEST(Repeat, AnyNumberOfThreadsIsTheSame) {
#if defined(TALUS_BACKEND_TBB)
  const auto on_threads = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return outcome(mixed_scene(), kSteps);
  };
#elif defined(TALUS_BACKEND_OMP)
  const auto on_threads = [](int threads) {
    omp_set_num_threads(threads);
    return outcome(mixed_scene(), kSteps);
  };
#else
  GTEST_SKIP() << "this back end has no threads of the CPU";
  const auto on_threads = [](int) { return std::string(); };
#endif
  const std::string one = on_threads(1);
  EXPECT_EQ(one, on_threads(2));
  EXPECT_EQ(one, on_threads(4));
}

TEST(Repeat, SceneIsWhatItIsMeantToBe) {
  dem_gpu::Simulation simulation(mixed_scene());
  std::size_t most_contacts = 0;
  for (int tenth = 0; tenth < 10; ++tenth) {
    simulation.advance(kSteps / 10);
    most_contacts = std::max(most_contacts, simulation.snapshot().contacts.size());
  }
  EXPECT_EQ(simulation.snapshot().wall_present[2], 0) << "the gate is open";
  EXPECT_GT(most_contacts, 5u);
  EXPECT_GT(simulation.quality().list_rebuilds, 2);
  const auto ledger = simulation.ledger();
  EXPECT_LT(std::abs(ledger.imbalance()), 0.02 * ledger.throughput);
}

}  // namespace
