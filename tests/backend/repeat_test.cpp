// SPDX-License-Identifier: Apache-2.0
// The same run gives the same bytes: twice, and on any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/periodic_scene.h"
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

TEST(Repeat, TwiceIsTheSame) {
  EXPECT_EQ(outcome(mixed_scene(), kSteps), outcome(mixed_scene(), kSteps));
  EXPECT_EQ(outcome(periodic_incline(), kSteps), outcome(periodic_incline(), kSteps));
}

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
  const auto on_threads = [](const dem_gpu::Scene& scene, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return outcome(scene, kSteps);
  };
#elif defined(TALUS_BACKEND_OMP)
  const auto on_threads = [](const dem_gpu::Scene& scene, int threads) {
    omp_set_num_threads(threads);
    return outcome(scene, kSteps);
  };
#else
  GTEST_SKIP() << "this back end has no threads of the CPU";
  const auto on_threads = [](const dem_gpu::Scene&, int) { return std::string(); };
#endif
  for (const dem_gpu::Scene& scene : {mixed_scene(), periodic_incline()}) {
    const std::string one = on_threads(scene, 1);
    EXPECT_EQ(one, on_threads(scene, 2));
    EXPECT_EQ(one, on_threads(scene, 4));
  }
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

TEST(Repeat, PeriodicSceneIsWhatItIsMeantToBe) {
  const dem_gpu::Scene scene = periodic_incline();
  dem_gpu::Simulation simulation(scene);
  int across = 0, wraps = 0;
  auto before = simulation.snapshot();
  for (int part = 0; part < 60; ++part) {
    simulation.advance(kSteps / 60);
    const auto now = simulation.snapshot();
    for (std::size_t i = 0; i < now.position.size(); ++i) {
      EXPECT_TRUE(!now.active[i] || is_in_box(*scene.periodic, now.position[i])) << "body " << i;
      wraps += norm(now.position[i] - before.position[i]) > 0.05;
    }
    for (const auto& contact : now.contacts)
      across += contact.body_b >= 0 && norm(now.position[contact.body_a] - now.position[contact.body_b]) > 0.04;
    before = now;
  }
  EXPECT_GT(across, 10) << "contacts across the faces";
  EXPECT_GT(wraps, 10) << "bodies through the faces";
  EXPECT_EQ(simulation.bulk().removed_bodies, 1);
  EXPECT_EQ(simulation.bulk().active_bodies + 1, static_cast<int>(scene.bodies.size()));
  const auto ledger = simulation.ledger();
  EXPECT_LT(std::abs(ledger.imbalance()), 0.02 * ledger.throughput);
}

}  // namespace
