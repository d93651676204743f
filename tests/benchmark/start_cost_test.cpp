// SPDX-License-Identifier: Apache-2.0
// Two bodies that overlap at the start against the same two apart. Weighing the energy of the overlap takes the forces
// at some forty places; the depth fields, which take nearly all of the time of both, are made once.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "dem_gpu/simulation.h"
#include "tests/support/non_convex_bodies.h"

namespace {

using namespace test_support;

/// Two hexapods, arm tip against arm tip, their faces `gap` apart [m].
dem_gpu::Scene two_hexapods(double gap) {
  dem_gpu::Scene scene;
  scene.gravity = {};
  scene.materials = {{"stone", 2700}};
  scene.contact = {{{0.5, 0.5}}};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.shapes = {dem_gpu::polyhedral_shape("hexapod", hexapod())};
  for (const double x : {0.0, 4 + gap}) {
    dem_gpu::Body body;
    body.position = {x, 0, 0};
    scene.bodies.push_back(body);
  }
  return scene;
}

/// Fastest of a few [s].
double time_to_start(const dem_gpu::Scene& scene) {
  double fastest = std::numeric_limits<double>::max();
  for (int i = 0; i < 10; ++i) {
    const auto before = std::chrono::steady_clock::now();
    const dem_gpu::Simulation simulation(scene);
    fastest = std::min(fastest, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  return fastest;
}

TEST(StartCost, OverlapsAreWeighedWithoutMakingTheShapesAnew) {
  const dem_gpu::Scene overlapping = two_hexapods(-0.01);
  ASSERT_GT(dem_gpu::Simulation(overlapping).ledger().elastic_normal, 0);
  const double ratio = time_to_start(overlapping) / time_to_start(two_hexapods(0.01));
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_LT(ratio, 5) << "some 40 where they are made anew for each force";
}

}  // namespace
