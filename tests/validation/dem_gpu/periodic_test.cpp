// SPDX-License-Identifier: Apache-2.0
// Periodic boxes: nothing depends on where the faces of the box are. References are the same bodies without a box, or
// with the box elsewhere.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/dem_runs.h"
#include "tests/support/periodic_scene.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;

/// Rounding of a double over one of a coordinate, times what a contact makes of it: a depth of 1e-3 of the body's size
/// is right to 1e-13 of itself. Contact geometry in single precision is computed in the bodies' own frames, whose
/// offset changes by as little, but may round to the next number.
constexpr double kRounding = kIsMixed ? 1e-5 : 1e-12;

TEST(PeriodicBox, FreeFlightIsUniformAndStaysInside) {
  Scene scene = empty_scene(1, 0);
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01), box_shape({kEdge, kEdge, kEdge})};
  scene.periodic = periodic_box({-0.05, 0.1, 1}, {0.12, 0.2, 0.1});
  scene.bodies = {body_at(0, {0, 0.15, 1.02}, {}, {6, 14, -4}), body_at(1, {0.03, 0.22, 1.07}, {}, {6, 14, -4})};
  scene.bodies[1].angular_velocity = {3, 4, 5};
  scene.run.time_step = 1.5e-5;
  Simulation simulation(scene);
  int crossings = 0;
  Vec3 before = scene.bodies[1].position;
  for (int step = 1; step <= 10000; ++step) {
    simulation.advance(1);
    const auto snapshot = simulation.snapshot();
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(is_in_box(*scene.periodic, snapshot.position[i])) << "step " << step;
      const Vec3 expected = scene.bodies[i].position + simulation.time() * scene.bodies[i].velocity;
      // 10^4 sums of coordinates of size 1.
      ASSERT_LT(norm(nearest_offset(*scene.periodic, snapshot.position[i], expected)), 1e-12) << "step " << step;
      ASSERT_EQ(snapshot.velocity[i], scene.bodies[i].velocity);
    }
    crossings += norm(snapshot.position[1] - before) > 0.05;
    before = snapshot.position[1];
  }
  EXPECT_GE(crossings, 20) << "7 along x, 10 along y, 6 along z, less those at one time";
  EXPECT_EQ(simulation.snapshot().contacts.size(), 0u);
}

struct Kind {
  const char* name;
  dem_gpu::Shape shape;
  dem_gpu::SphereLaw sphere_law = dem_gpu::LinearSpring{1e5};
};

std::vector<Kind> kinds() {
  return {{"balls", dem_gpu::sphere_shape("ball", kEdge / 2)},
          {"Hertz balls", dem_gpu::sphere_shape("ball", kEdge / 2), dem_gpu::Hertz{}},
          {"cubes", box_shape({kEdge, kEdge, kEdge})},
          {"bodies of two parts", box_shape({1.4 * kEdge, kEdge, 0.8 * kEdge}, {2, 1, 1})}};
}

/// Two spinning bodies of one kind, or a ball on the kind, that meet obliquely about `place`.
Scene collision(const Kind& kind, bool with_ball, const Vec3& place) {
  Scene scene = empty_scene(0.6, 0.4);
  scene.sphere_law = kind.sphere_law;
  scene.shapes = {kind.shape, dem_gpu::sphere_shape("ball", 0.4 * kEdge)};
  const Vec3 apart = 0.62 * kEdge * Vec3{1, 0.8, 0.6};
  // The ball first: then the pair is met by the body of higher index, at the ghost of the lower one.
  scene.bodies = {body_at(with_ball, place + apart, dem_gpu::axis_angle({0.6, 0, 0.8}, 0.7), {-0.8, -0.5, -0.7}),
                  body_at(0, place - apart, dem_gpu::axis_angle({0, 0.6, 0.8}, 0.4), {0.3, 0.2, 0.1})};
  scene.bodies[0].angular_velocity = {30, -20, 10};
  scene.bodies[1].angular_velocity = {-10, 25, 15};
  scene.run.time_step = 1e-5;
  return scene;
}

/// Largest difference of the two bodies' motion, in terms of the speed of approach and the size.
double difference(const dem_gpu::PeriodicBox& box, const Vec3& shift, const dem_gpu::Snapshot& one,
                  const dem_gpu::Snapshot& other) {
  double largest = 0;
  for (std::size_t i = 0; i < one.position.size(); ++i) {
    largest = std::max({largest, norm(nearest_offset(box, one.position[i] + shift, other.position[i])) / kEdge,
                        norm(one.velocity[i] - other.velocity[i]),
                        kEdge * norm(one.angular_velocity[i] - other.angular_velocity[i])});
  }
  return largest;
}

/// Middles of the box, of its faces, of its edges, and its corner: opposite ones are one place.
std::vector<Vec3> places(const Vec3& length) {
  std::vector<Vec3> centres;
  for (int i = 0; i < 8; ++i) centres.push_back(0.5 * hadamard({Real(i & 1), Real(i >> 1 & 1), Real(i >> 2)}, length));
  return centres;
}

TEST(PeriodicBox, CollisionIsTheSameAcrossFacesEdgesAndCorners) {
  const Vec3 length{0.128, 0.16, 0.144};
  const dem_gpu::PeriodicBox box = periodic_box(-0.5 * length, length);
  constexpr int kSteps = 1300;
  for (const Kind& kind : kinds())
    for (const bool with_ball : {false, true}) {
      Simulation free(collision(kind, with_ball, {}));
      const auto before = free.snapshot();
      free.advance(kSteps);
      const auto expected = free.snapshot();
      ASSERT_GT(norm(before.velocity[0] - expected.velocity[0]), 0.1) << kind.name << " must collide";
      // The measure of rounding: the same collision without a box, moved to where coordinates are as large.
      double moved = 0, periodic = 0;
      for (const Vec3& centre : places(length)) {
        Scene scene = collision(kind, with_ball, centre);
        Simulation elsewhere(scene);
        elsewhere.advance(kSteps);
        moved = std::max(moved, difference(box, centre, expected, elsewhere.snapshot()));
        scene.periodic = box;
        for (dem_gpu::Body& body : scene.bodies) body.position = in_box(box, body.position);
        Simulation across(scene);
        across.advance(kSteps);
        periodic = std::max(periodic, difference(box, centre, expected, across.snapshot()));
        const auto ledger = across.ledger(), free_ledger = free.ledger();
        EXPECT_NEAR(ledger.dissipated(), free_ledger.dissipated(), 10 * kRounding * ledger.initial) << kind.name;
        EXPECT_NEAR(ledger.imbalance(), free_ledger.imbalance(), 10 * kRounding * ledger.initial) << kind.name;
      }
      std::printf("  %s%s, across faces, edges and the corner: differ by %.1e of speed and size; moved %.1e\n",
                  kind.name, with_ball ? " and a ball" : "", periodic, moved);
      EXPECT_LT(periodic, std::max(4 * moved, kRounding)) << kind.name;
      EXPECT_LT(moved, 1e3 * kRounding) << kind.name << ": rounding measures nothing here";
    }
}

/// A dense cloud with friction in a fully periodic box, its places moved by `shift`.
Scene cloud(const Vec3& shift) {
  Scene scene = empty_scene(0.5, 0.4);
  scene.gravity = {1, 2, -3};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.periodic = periodic_box({0, 0, 0}, 3 * 2 * kEdge * Vec3{1, 1, 1});
  for (const Kind& kind : {kinds()[0], kinds()[2], kinds()[3]}) scene.shapes.push_back(kind.shape);
  std::mt19937 random(5);
  for (int i = 0; i < 27; ++i) {
    const Vec3 place = 2 * kEdge * Vec3{i % 3 + 0.5, i / 3 % 3 + 0.5, i / 9 + 0.5};
    scene.bodies.push_back(
        body_at(i % 3, in_box(*scene.periodic, place + shift), random_rotation(random), 2 * random_direction(random)));
    scene.bodies.back().angular_velocity = 50 * random_direction(random);
  }
  scene.run.time_step = 1e-5;
  return scene;
}

TEST(PeriodicBox, MovedSceneMovesAlike) {
  std::mt19937 random(6);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Simulation here(cloud({}));
  here.advance(2500);
  EXPECT_GT(here.ledger().dissipated(), 0.3 * here.ledger().initial) << "there must be collisions";
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 shift{uniform(random), uniform(random), uniform(random)};
    const Scene scene = cloud(shift);
    Simulation there(scene);
    there.advance(2500);
    const double off = difference(*scene.periodic, shift, here.snapshot(), there.snapshot());
    largest = std::max(largest, off);
    // Each collision of round bodies multiplies a difference by the free path over the radius, some 3; a body has five
    // to seven of them here.
    EXPECT_LT(off, 3e3 * kRounding);
    EXPECT_NEAR(there.ledger().kinetic, here.ledger().kinetic, 3e3 * kRounding * here.ledger().initial);
  }
  std::printf("  27 bodies moved by random vectors: differ by %.1e of speed and size after 25 ms\n", largest);
}

TEST(PeriodicBox, ElasticGasKeepsMomentumAndEnergy) {
  for (const bool is_round : {true, false}) {
    Scene scene = empty_scene(1, 0);
    scene.periodic = periodic_box({-0.1, 0, 0.1}, 4 * 1.6 * kEdge * Vec3{1, 1, 1});
    scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
    scene.shapes = {is_round ? dem_gpu::sphere_shape("ball", kEdge / 2) : box_shape({kEdge, kEdge, kEdge})};
    std::mt19937 random(9);
    Vec3 momentum;
    for (int i = 0; i < 64; ++i) {
      const Vec3 place = Vec3{-0.1, 0, 0.1} + 1.6 * kEdge * Vec3{i % 4 + 0.5, i / 4 % 4 + 0.5, i / 16 + 0.5};
      scene.bodies.push_back(
          body_at(0, place, dem_gpu::axis_angle({1, 0, 0}, 0.1 * (i % 3)), random_direction(random)));
      momentum += scene.bodies.back().velocity;
    }
    scene.run.steps_per_contact = 40;
    Simulation simulation(scene);
    double largest = 0, met = 0;
    for (int part = 0; part < 20; ++part) {
      run_to(simulation, 0.01 * (part + 1));
      Vec3 now;
      for (const Vec3& velocity : simulation.snapshot().velocity) now += velocity;
      largest = std::max(largest, norm(now - momentum) / 64);
      met += simulation.bulk().contacts;
    }
    const auto ledger = simulation.ledger();
    std::printf("  elastic gas of 64 %s, %lld steps: momentum %.1e of m v each, energy %.1e\n",
                is_round ? "balls" : "cubes", static_cast<long long>(simulation.step()), largest,
                ledger.imbalance() / ledger.initial);
    EXPECT_GT(met, 20) << "the gas must collide";
    EXPECT_LT(largest, 1e-12);
    EXPECT_EQ(ledger.dissipated(), 0);
    // The integrator's error, as in a box of walls (Ledger.ClosesInAnElasticBox).
    EXPECT_LT(std::abs(ledger.imbalance()), 2e-4 * ledger.initial);
  }
}

/// Largest difference of the bodies' paths from those on an endless plane, in sizes, looked at 100 times.
double path_difference(Scene scene, const dem_gpu::PeriodicBox& box, int steps) {
  Simulation endless(scene);
  scene.periodic = box;
  Simulation periodic(scene);
  double largest = 0;
  for (int look = 0; look < 100; ++look) {
    endless.advance(steps / 100);
    periodic.advance(steps / 100);
    largest = std::max(largest, difference(box, {}, endless.snapshot(), periodic.snapshot()));
  }
  const auto end = endless.snapshot();
  EXPECT_GT(norm(end.position[0] - scene.bodies[0].position), box.span[0]->high - box.span[0]->low)
      << "it must cross a face";
  EXPECT_NEAR(periodic.ledger().gravitational, endless.ledger().gravitational,
              100 * kRounding * endless.ledger().throughput);
  EXPECT_NEAR(periodic.ledger().imbalance(), endless.ledger().imbalance(),
              100 * kRounding * endless.ledger().throughput);
  return largest;
}

Scene incline(double angle, double friction) {
  Scene scene = empty_scene(0.3, friction);
  scene.gravity = 9.81 * Vec3{std::sin(angle), 0, -std::cos(angle)};
  scene.walls = {floor_wall()};
  scene.run.time_step = 1e-5;
  return scene;
}

// On the endless plane coordinates grow to some ten sizes and with them their rounding; it adds up along the path.
constexpr double kPathRounding = 100 * kRounding;

TEST(PeriodicIncline, BlockSlidesThroughTheFaceAsOnAnEndlessPlane) {
  Scene scene = incline(0.5, 0.4);
  scene.shapes = {box_shape({kEdge, kEdge, kEdge}, {2, 1, 1})};
  scene.bodies = {body_at(0, {0, 0, kEdge / 2}, {}, {0.3, 0, 0})};
  const double off = path_difference(scene, periodic_box({-0.04, -0.05, 0}, {0.08, 0.1, 0}, "xy"), 50000);
  std::printf("  block down an incline through 8 faces: path differs by %.1e of its size\n", off);
  EXPECT_LT(off, kPathRounding);
}

TEST(PeriodicIncline, StuckBlocksAreCarriedThroughTheFace) {
  // A belt carries a block with another on it through the faces; gravity is tilted to below the angle of friction, so
  // that springs alone hold both. Lost springs would let the upper block creep at each face.
  Scene scene = incline(0.25, 0.4);
  scene.shapes = {box_shape({kEdge, kEdge, kEdge}), box_shape({0.8 * kEdge, kEdge, kEdge}, {2, 1, 1})};
  scene.bodies = {body_at(0, {0, 0, kEdge / 2}, {}, {0.5, 0, 0}),
                  body_at(1, {-0.1 * kEdge, 0.002, 1.5 * kEdge}, {}, {0.5, 0, 0})};
  scene.walls[0].motion.velocity = {0.5, 0, 0};
  const double off = path_difference(scene, periodic_box({-0.06, -0.06, 0}, {0.12, 0.12, 0}, "xy"), 60000);
  Simulation simulation(scene);
  simulation.advance(10000);
  const auto settled = simulation.snapshot();
  simulation.advance(50000);
  const auto end = simulation.snapshot();
  const double creep = norm(end.position[1] - settled.position[1] - Vec3{0.25, 0, 0});
  std::printf("  two blocks on a belt through 2 faces: path differs by %.1e of their size, creep %.1e m\n", off, creep);
  EXPECT_LT(creep, 1e-6) << "the reference itself sticks";
  EXPECT_LT(off, kPathRounding);
}

/// Balls drop onto fixed balls on an incline at the angle of friction.
Scene rough_slope(const Vec3& shift, double nudge) {
  Scene scene = incline(std::atan(0.4), 0.4);
  scene.periodic = periodic_box({0, 0, 0}, {6 * kEdge, 4 * kEdge, 0}, "xy");
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.48 * kEdge)};
  std::mt19937 random(4);
  for (int i = 0; i < 48; ++i) {
    const bool is_fixed = i < 24;
    const Real half = is_fixed ? 0.5 : 1;
    const Vec3 aside = is_fixed ? Vec3{} : 0.03 * kEdge * random_direction(random) + nudge * Vec3{1, -1, 1};
    const Vec3 place = kEdge * Vec3{i % 6 + half, i / 6 % 4 + half, is_fixed ? 0.5 : 1.25};
    scene.bodies.push_back(body_at(0, in_box(*scene.periodic, place + aside + shift)));
    scene.bodies.back().is_fixed = is_fixed;
  }
  return scene;
}

TEST(PeriodicIncline, RoughSlopeIsTheSameWhereverTheFacesAre) {
  constexpr int kSteps = 4000;
  Simulation here(rough_slope({}, 0));
  here.advance(kSteps);
  EXPECT_GT(here.bulk().contacts, 10);
  // Bouncing balls part exponentially: the measure is the same slope with the balls started a rounding error aside, of
  // the sum of some 10^3 steps.
  Simulation nudged(rough_slope({}, 1e-14));
  nudged.advance(kSteps);
  const dem_gpu::PeriodicBox box = *rough_slope({}, 0).periodic;
  const double apart = difference(box, {}, here.snapshot(), nudged.snapshot());
  for (const Vec3& shift : {Vec3{0.0371, -0.0519, 0}, Vec3{0.06, 0, 0}, Vec3{0, 0.04, 0}}) {
    Simulation there(rough_slope(shift, 0));
    there.advance(kSteps);
    const double off = difference(box, shift, here.snapshot(), there.snapshot());
    std::printf("  24 balls on a rough slope, faces moved: differ by %.1e of size and speed, started aside %.1e\n", off,
                apart);
    EXPECT_EQ(here.bulk().contacts, there.bulk().contacts);
    EXPECT_LT(off, 10 * apart);
    EXPECT_LT(apart, 1e-4) << "the start is forgotten: nothing is measured";
  }
}

}  // namespace
