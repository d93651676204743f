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

TEST(FailedRun, NamesStepAndBody) {
  dem_gpu::Scene scene = mixed_scene();
  scene.bodies[7].velocity = {0, 0, 5000};  // 50 mm a step
  dem_gpu::Simulation simulation(scene);
  try {
    simulation.advance(10);
    FAIL() << "must stop";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("step 1,"), std::string::npos) << message;
    EXPECT_NE(message.find("body 7 "), std::string::npos) << message;
    EXPECT_NE(message.find("time step"), std::string::npos) << message;
  }
}

TEST(FailedRun, DeepOverlapAtTheStartStopsOrFlies) {
  // Two cubes in one place push apart with a bounded force; no state is ever other than finite.
  dem_gpu::Scene scene = empty_scene(0.5, 0.5);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}), dem_gpu::sphere_shape("ball", 0.01)};
  scene.bodies = {body_at(0, {}), body_at(0, {}), body_at(1, {1, 0, 0}), body_at(1, {1, 0, 0})};
  dem_gpu::Simulation simulation(scene);
  try {
    simulation.advance(2000);
    for (const Vec3& x : simulation.snapshot().position) EXPECT_TRUE(std::isfinite(norm(x)));
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("step "), std::string::npos);
  }
}

}  // namespace
