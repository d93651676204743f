// SPDX-License-Identifier: Apache-2.0
// Bad starts are refused, broken runs stop with step, body and remedy; fixed bodies; bodies far apart.
#include <gtest/gtest.h>

#include "catalog/input_error.h"
#include "tests/support/dem_runs.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/solids.h"

namespace {

using namespace test_support;

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

/// Two cubes, `shift` apart, and two balls far off.
dem_gpu::Scene overlapping_cubes(double shift) {
  dem_gpu::Scene scene = empty_scene(0.5, 0.5);
  scene.shapes = {box_shape({0.02, 0.02, 0.02}), dem_gpu::sphere_shape("ball", 0.01)};
  scene.bodies = {body_at(0, {}), body_at(0, {0, 0, shift}), body_at(1, {1, 0, 0}), body_at(1, {1, 0, 0.02})};
  return scene;
}

TEST(FailedRun, DeepOverlapAtTheStartIsRefusedByName) {
  for (const double shift : {0.0, 0.004, 0.0175}) {
    const std::string message = [&] {
      try {
        dem_gpu::Simulation simulation(overlapping_cubes(shift));
        return std::string("accepted");
      } catch (const catalog::InputError& error) {
        return std::string(error.what());
      }
    }();
    EXPECT_NE(message.find("body 0 and body 1 overlap at the start"), std::string::npos) << message;
    EXPECT_NE(message.find("largest_start_overlap"), std::string::npos) << message;
  }
  EXPECT_NO_THROW(dem_gpu::Simulation(overlapping_cubes(0.019)));  // 5 % of the edge
}

/// A row of spheres that touch, and two more that fly through one another, or one through a floor.
dem_gpu::Scene row_and_shots(bool is_at_floor) {
  dem_gpu::Scene scene = empty_scene(0.5, 0.5);
  scene.gravity = {};
  scene.sphere_law = dem_gpu::LinearSpring{20};
  scene.run.time_step = 2e-5;
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  for (int i = 0; i < 60; ++i) scene.bodies.push_back(body_at(0, {0.0199 * i, 0, 0.0099}));
  scene.bodies.push_back(body_at(0, {0, 1, is_at_floor ? 0.021 : 0.1}));
  scene.bodies.push_back(body_at(0, {0.031, 1, 0.1}));
  scene.bodies[60].scale = 2;
  scene.bodies[60].velocity = is_at_floor ? Vec3{0, 0, -4} : Vec3{4, 0, 0};
  scene.bodies[61].velocity = is_at_floor ? Vec3{} : Vec3{-4, 0, 0};
  scene.walls = {floor_wall()};
  return scene;
}

TEST(FailedRun, BodiesPushedThroughOneAnotherAreNamed) {
  for (const bool is_at_floor : {false, true}) {
    dem_gpu::Simulation simulation(row_and_shots(is_at_floor));
    try {
      simulation.advance(2000);
      FAIL() << "must stop";
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      const std::string pair = is_at_floor ? "body 60 and wall 'floor'" : "body 60 and body 61";
      EXPECT_NE(message.find(pair + " have sunk into one another"), std::string::npos) << message;
    }
  }
}

std::string refusal(const dem_gpu::Scene& scene) {
  try {
    dem_gpu::Simulation simulation(scene);
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_named(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(BadWall, TooFastIsRefusedByName) {
  dem_gpu::Scene scene = overlapping_cubes(0.1);
  dem_gpu::Wall lid = floor_wall("lid"), mill = floor_wall("mill");
  for (dem_gpu::Wall* wall : {&lid, &mill}) std::get<dem_gpu::Plane>(wall->geometry).point.z = -3;
  lid.motion.velocity = {0, 0, 0.1};
  mill.motion.velocity = {0, 0, 0.02 / dem_gpu::time_step(scene)};  // an edge of the cubes a step
  scene.walls = {lid, mill};
  expect_named(refusal(scene), {"wall 'mill'", "quarter of the least width of body 0", "time step of at most"});
  scene.walls = {lid};
  EXPECT_EQ(refusal(scene), "accepted");
}

TEST(BadWall, SwingTheStepCannotFollowIsRefusedByName) {
  dem_gpu::Scene scene = overlapping_cubes(0.1);
  dem_gpu::Wall sieve = floor_wall("sieve");
  std::get<dem_gpu::Plane>(sieve.geometry).point.z = -3;
  sieve.motion.amplitude = {0, 0, 1e-6};
  sieve.motion.frequency = 1 / (10 * dem_gpu::time_step(scene));
  scene.walls = {sieve};
  expect_named(refusal(scene), {"wall 'sieve'", "10 steps", "at least 20", "time step of at most"});
  scene.walls[0].motion.frequency /= 2.01;
  EXPECT_EQ(refusal(scene), "accepted");
}

TEST(BadContact, RollingFrictionThatNoStepFollowsIsRefused) {
  dem_gpu::Scene scene = overlapping_cubes(0.1);
  scene.contact[0][0].rolling_friction = 1;
  EXPECT_EQ(refusal(scene), "accepted");
  scene.contact[0][0].rolling_friction = 1e300;
  expect_named(refusal(scene), {"contact of '", "rolling friction must be at most 1"});
}

TEST(BadWall, AMotionBeyondReckoningIsRefused) {
  dem_gpu::Scene scene = overlapping_cubes(0.1);
  scene.walls = {floor_wall()};
  std::get<dem_gpu::Plane>(scene.walls[0].geometry).point.z = -5;
  scene.walls[0].motion.velocity = {0, 0, 1e300};
  expect_named(refusal(scene), {"wall 'floor'", "too fast to reckon with"});
}

TEST(BadWall, TwoMovingObjectsOfOneNameAreRefused) {
  dem_gpu::Scene scene = overlapping_cubes(0.1);
  dem_gpu::Wall lifter;
  lifter.name = "lifter";
  lifter.motion.velocity = {0, 0, 0.1};
  lifter.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.02, 0.02}), {}, {0, 0, -1})};
  scene.walls = {lifter, lifter};
  scene.walls[1].geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.02, 0.02}), {}, {0, 0, -2})};
  expect_named(refusal(scene), {"wall 'lifter'", "two of that name"});
}

TEST(BadWall, MeshesThatEncloseNothingAreRefusedByName) {
  const catalog::TriangleMesh cube = solids::box({-1, -1, -3}, {1, 1, -2});
  const auto refused = [](catalog::TriangleMesh mesh) {
    dem_gpu::Scene scene = overlapping_cubes(0.1);
    dem_gpu::Wall bin;
    bin.name = "bin";
    bin.geometry = dem_gpu::MeshObject{std::move(mesh)};
    scene.walls = {floor_wall(), bin};
    std::get<dem_gpu::Plane>(scene.walls[0].geometry).point.z = -5;
    return refusal(scene);
  };
  EXPECT_EQ(refused(cube), "accepted");
  catalog::TriangleMesh open = cube, inverted = cube, crossed = cube;
  open.faces.pop_back();
  expect_named(refused(open), {"wall 'bin'", "give the sheet a thickness"});
  for (auto& face : inverted.faces) std::swap(face[0], face[1]);
  expect_named(refused(inverted), {"wall 'bin'", "inverted"});
  for (const auto& p : solids::box({0.5, -0.5, -2.6}, {1.5, 0.5, -2.4}).vertices) crossed.vertices.push_back(p);
  for (const auto& [a, b, c] : cube.faces) crossed.faces.push_back({a + 8, b + 8, c + 8});
  expect_named(refused(crossed), {"wall 'bin'", "pass through each other"});
}

TEST(FailedRun, DeepOverlapIsAllowedWhenAskedForAndItsEnergyIsCounted) {
  dem_gpu::Scene scene = overlapping_cubes(0.012);
  scene.contact = {{{1, 0}}};
  scene.friction = std::nullopt;
  scene.run.largest_start_overlap = 1;
  dem_gpu::Simulation simulation(scene);
  // U = 2 k * integral over the overlap of the distance to the nearest face of one cube, capped: less than with the
  // distance from the facing faces alone, uncapped, k a^2 d^2, and more than a third of it (pyramids on the faces).
  const double edge = 0.02, depth = 0.008, flat = 1e9 * edge * edge * depth * depth;
  const double stored = simulation.ledger().initial;
  EXPECT_LT(stored, flat);
  EXPECT_GT(stored, 0.1 * flat);
  simulation.advance(2000);
  const auto ledger = simulation.ledger();
  EXPECT_EQ(ledger.elastic_normal, 0);
  // The quadrature of the stored energy and the steps' own error at 20 steps a contact.
  EXPECT_NEAR(ledger.kinetic / stored, 1, 2e-3);
}

TEST(FixedBody, StaysAndCarriesOthers) {
  dem_gpu::Scene scene = empty_scene(0.3, 0.5);
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {box_shape({0.02, 0.02, 0.02}), dem_gpu::sphere_shape("ball", 0.005)};
  scene.bodies = {body_at(0, {0, 0, 0.3}), body_at(0, {0.001, 0.002, 0.32001}), body_at(1, {0, 0, 0.33503})};
  scene.bodies[0].is_fixed = true;
  dem_gpu::Simulation simulation(scene);
  run_to(simulation, 0.1);
  const auto snapshot = simulation.snapshot();
  EXPECT_EQ(snapshot.position[0], scene.bodies[0].position);
  EXPECT_EQ(snapshot.active[0], 1);
  // Sinks in by m g / (2 k A) = 0.25 um under its own weight and the ball's 1.3 g.
  EXPECT_NEAR(snapshot.position[1].z, 0.32, 1e-6);
  EXPECT_LT(std::abs(simulation.ledger().imbalance()), 2e-3 * simulation.ledger().throughput);
  scene.bodies[0].velocity = {1, 0, 0};
  EXPECT_THROW(dem_gpu::Simulation{scene}, catalog::InputError);
}

TEST(FarApart, BodiesMillionsOfSizesAwayChangeNothing) {
  // Two columns of three cubes, 10^8 edges apart along every axis: more cells than a grid key has room for.
  const auto falling = [](bool has_company) {
    dem_gpu::Scene scene = empty_scene(0.5, 0.5);
    scene.gravity = {0, 0, -9.81};
    scene.shapes = {box_shape({0.02, 0.02, 0.02})};
    const auto column = [&](const Vec3& at) {
      for (int i = 0; i < 3; ++i) scene.bodies.push_back(body_at(0, at + Vec3{0.001 * i, 0, 0.01 + 0.025 * i}));
    };
    column({});
    if (has_company) column({2e6, 2e6, 2e6});
    scene.bodies[0].is_fixed = true;
    dem_gpu::Simulation simulation(scene);
    run_to(simulation, 0.05);  // the 5 mm are fallen through in 32 ms
    return simulation.snapshot();
  };
  const auto alone = falling(false), together = falling(true);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(alone.position[i], together.position[i]);
    EXPECT_EQ(alone.velocity[i], together.velocity[i]);
  }
  // They met on the way: free fall would be faster.
  EXPECT_GT(together.velocity[1].z, -9.81 * 0.05 + 0.1);
}

}  // namespace
