// SPDX-License-Identifier: Apache-2.0
// Periodic boxes that cannot be simulated are refused with figures and remedy, at the start too.
#include "dem_gpu/periodic/periodic_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "catalog/input_error.h"
#include "dem_gpu/periodic/wall_extent.h"
#include "dem_gpu/simulation.h"
#include "dem_gpu/walls/wall_motion.h"
#include "tests/support/periodic_scene.h"
#include "tests/support/wall_meshes.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;

/// Cubes of bounding radius 0.01 sqrt(3) m in a box of 0.08 m, over a floor.
Scene cubes() {
  Scene scene = empty_scene(0.5, 0.4);
  scene.shapes = {box_shape({0.02, 0.02, 0.02})};
  scene.bodies = {body_at(0, {0.01, 0.01, 0.05}), body_at(0, {0.05, 0.05, 0.05})};
  scene.walls = {floor_wall()};
  scene.periodic = periodic_box({0, 0, 0}, {0.08, 0.08, 0}, "xy");
  return scene;
}

using Change = std::function<void(Scene&)>;

std::string refusal(const Change& change) {
  Scene scene = cubes();
  change(scene);
  try {
    dem_gpu::Simulation simulation(scene);
    return "accepted";
  } catch (const catalog::InputError& error) {
    return error.what();
  }
}

void expect_refused(const Change& change, const std::vector<std::string>& words) {
  const std::string message = refusal(change);
  for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << word << ": " << message;
}

TEST(PeriodicCheck, TakesWhatFits) {
  EXPECT_EQ(refusal([](Scene&) {}), "accepted");
  const Real least = 8 * 0.01 * std::sqrt(3.0);  // 2 (r1 + r2)
  EXPECT_EQ(refusal([&](Scene& s) {
              s.periodic = periodic_box({0, 0, 0}, (least + 1e-9) * Vec3{1, 1, 1}, "xy");
            }),
            "accepted");
}

TEST(PeriodicCheck, RefusesABoxThatIsNone) {
  expect_refused([](Scene& s) { s.periodic = dem_gpu::PeriodicBox{}; }, {"periodic box", "no span"});
  expect_refused([](Scene& s) { s.periodic->span[1] = {{0.08, 0}}; }, {"along y", "0.08 m .. 0 m", "less than"});
  expect_refused([](Scene& s) { s.periodic->span[1] = {{0.02, 0.02}}; }, {"along y", "less than"});
  expect_refused([](Scene& s) { s.periodic->span[0] = {{0, std::numeric_limits<Real>::infinity()}}; }, {"along x"});
}

TEST(PeriodicCheck, RefusesABoxTooNarrow) {
  expect_refused(
      [](Scene& s) {
        s.periodic = periodic_box({0, 0, 0}, {0.08, 0.069, 0}, "xy");
      },
      {"0.069 m wide along y", "two of another", "0.0173205 m", "at least 0.069282 m"});
  expect_refused(
      [](Scene& s) {
        s.bodies.resize(1);
        s.periodic = periodic_box({0, 0, 0}, {0.08, 0.034, 0}, "xy");
      },
      {"own image", "at least 0.034641 m"});
}

TEST(PeriodicCheck, RefusesBodiesOutside) {
  expect_refused([](Scene& s) { s.bodies[1].position.x = 0.08; }, {"body 1", "x = 0.08 m", "outside"});
  expect_refused([](Scene& s) { s.bodies[0].position.y = -1e-9; }, {"body 0", "y = -1e-09 m", "outside"});
  EXPECT_EQ(refusal([](Scene& s) { s.bodies[1].position.z = 5; }), "accepted") << "not periodic along z";
}

TEST(PeriodicCheck, RefusesWallsThatEndAtAFace) {
  const auto wall = [](auto geometry) { return [geometry](Scene& s) { s.walls[0].geometry = geometry; }; };
  using dem_gpu::VolumeObject;
  const auto slab = [](Real low, Real high) {
    return VolumeObject{moved_part(dem_gpu::box_part({high - low, 0.2, 0.01}), {}, {(low + high) / 2, 0.04, -0.01})};
  };
  expect_refused(wall(dem_gpu::Plane{{0, 0, 0}, {0.6, 0, 0.8}}), {"wall 'floor'", "leans towards x", "tilt gravity"});
  expect_refused(wall(dem_gpu::Ball{{0.3, 0.04, 0}, 0.02, dem_gpu::SolidSide::within}), {"outside the periodic box"});
  expect_refused(wall(slab(0, 0.08)), {"0 m .. 0.08 m along x", "past both faces by 0.0207846 m"});
  expect_refused(wall(slab(0.03, 0.2)), {"past both faces"});
  expect_refused(wall(dem_gpu::Disc{{0.04, 0.04, 0}, {0, 0, 1}, 0.05}), {"past both faces"});
  expect_refused(wall(dem_gpu::Cylinder{{0.04, 0, 0}, {0, 1, 0}, 0.08, 0.01, dem_gpu::SolidSide::within}),
                 {"0 m .. 0.08 m along y"});
  expect_refused(wall(dem_gpu::Cone{{0.04, -1, 0}, {0, 1, 0}, 1.08, 0.005, 0.01, dem_gpu::SolidSide::within}),
                 {"-1 m .. 0.08 m along y"});
  expect_refused(wall(dem_gpu::MeshObject{flat_sheet(0.05, 1), 0.1}), {"past both faces"});
  EXPECT_EQ(refusal(wall(slab(-0.03, 0.11))), "accepted");
  EXPECT_EQ(refusal(wall(dem_gpu::Disc{{0.04, 0.04, 0}, {0, 0, 1}, 0.1})), "accepted");
  EXPECT_EQ(refusal(wall(dem_gpu::Ball{{0.04, 0.04, 0}, 0.01, dem_gpu::SolidSide::within})), "accepted");
}

TEST(PeriodicCheck, RefusesWallsThatTurnThroughAFace) {
  const auto turning = [](const Vec3& angular_velocity, const Vec3& amplitude, Real radius) {
    return [=](Scene& s) {
      s.periodic->span[1].reset();
      s.walls[0].geometry = dem_gpu::Cylinder{{-0.03, 0.04, 0}, {1, 0, 0}, 0.14, radius};
      s.walls[0].motion.angular_velocity = angular_velocity;
      s.walls[0].motion.angular_amplitude = amplitude;
    };
  };
  EXPECT_EQ(refusal(turning({3, 0, 0}, {}, 0.5)), "accepted");
  expect_refused(turning({3, 0.1, 0}, {}, 0.5), {"wall 'floor'", "another axis than x", "turn it about x"});
  expect_refused(turning({}, {0, 0, 0.1}, 0.5), {"another axis than x"});
}

TEST(PeriodicCheck, RefusesWallsThatLeaveByTheirMotion) {
  // Along x, a block of 2 cm in the middle of 16 cm, bodies reaching 2.08 cm: clear by 4.92 cm on both sides.
  const auto moving = [](const dem_gpu::Motion& motion, Real end_time, std::optional<Real> removed_at = {}) {
    return refusal([&](Scene& s) {
      s.periodic = periodic_box({0, 0, 0}, {0.16, 0, 0}, "x");
      s.walls[0].geometry =
          dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({0.02, 0.1, 0.01}), {}, {0.08, 0.2, -0.01})};
      s.walls[0].motion = motion;
      s.walls[0].removed_at = removed_at;
      s.run.end_time = end_time;
    });
  };
  const auto expect_words = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("wall 'floor': by its motion up to"), std::string::npos) << message;
  };
  dem_gpu::Motion drift;
  drift.velocity = {0.01, 3, 0};
  EXPECT_EQ(moving(drift, 4.9), "accepted");
  expect_words(moving(drift, 5), "it gets to 0.07 m .. 0.14 m along x");
  EXPECT_EQ(moving(drift, 5, 4.9), "accepted") << "removed before";
  expect_words(moving(drift, 0), "no end of the run");

  dem_gpu::Motion oscillation;
  oscillation.amplitude = {0.049, 0, 0};
  oscillation.frequency = 5;
  EXPECT_EQ(moving(oscillation, 1), "accepted");
  oscillation.phase = std::numbers::pi / 2;  // from -2 to 0 amplitudes
  expect_words(moving(oscillation, 1), "-0.028 m .. 0.09 m");
  EXPECT_EQ(moving(oscillation, 0.05), "accepted") << "one amplitude on the way";

  dem_gpu::Motion rotation;  // about z, one end of the block
  rotation.rotation_centre = {0.08, 0.15, 0};
  rotation.angular_velocity = {0, 0, 0.1};
  EXPECT_EQ(moving(rotation, 4), "accepted") << "0.4 rad: the far end is 0.1 sin(0.4) + 0.01 cos(0.4) out";
  expect_words(moving(rotation, 8), "along x");
  dem_gpu::Motion swing;
  swing.rotation_centre = rotation.rotation_centre;
  swing.angular_amplitude = {0, 0, 0.4};
  swing.frequency = 2;
  EXPECT_EQ(moving(swing, 1), "accepted");
  swing.angular_amplitude.z = 0.8;
  expect_words(moving(swing, 1), "along x");

  // Past both faces by 1 cm more than needed: 0.9 cm of drift is fine.
  const auto slab = [](Real end_time) {
    return refusal([&](Scene& s) {
      const Real length = 0.08 + 2 * (1.2 * 0.01 * std::sqrt(3.0) + 0.01);
      s.walls[0].geometry =
          dem_gpu::VolumeObject{moved_part(dem_gpu::box_part({length, length, 0.01}), {}, {0.04, 0.04, -0.01})};
      s.walls[0].motion.velocity = {0, 0.01, 0};
      s.run.end_time = end_time;
    });
  };
  EXPECT_EQ(slab(0.9), "accepted");
  expect_words(slab(1.1), "along y");
}

TEST(PeriodicCheck, SweptExtentIsThatOfTheMovedWall) {
  // Against the wall's corners moved step by step.
  dem_gpu::Wall wall;
  const catalog::ConvexPart part = moved_part(dem_gpu::box_part({0.1, 0.02, 0.03}), {}, {0.3, -0.1, 0.2});
  wall.geometry = dem_gpu::VolumeObject{part};
  dem_gpu::Motion rotation;
  rotation.rotation_centre = {0.2, 0.1, 0};
  rotation.angular_velocity = {0.3, -0.5, 0.9};
  dem_gpu::Motion swing = rotation;
  swing.angular_velocity = {};
  swing.angular_amplitude = {0.2, 0.3, -0.4};
  swing.frequency = 0.4;
  swing.phase = 0.7;
  for (const dem_gpu::Motion& motion : {rotation, swing}) {
    wall.motion = motion;
    for (const Real until : {0.5, 1.5, 9.0})
      for (int axis = 0; axis < 3; ++axis) {
        Real low = 1e9, high = -1e9;
        constexpr int kSteps = 20000;
        for (int step = 0; step <= kSteps; ++step) {
          const dem_gpu::WallPlace at = place_at(motion, until * step / kSteps);
          for (const catalog::Point& p : part.vertices) {
            const Vec3 x = motion.rotation_centre +
                           dem_gpu::rotate(at.rotation, Vec3{p[0], p[1], p[2]} - motion.rotation_centre) + at.shift;
            low = std::min(low, dem_gpu::component(x, axis));
            high = std::max(high, dem_gpu::component(x, axis));
          }
        }
        const dem_gpu::Extent swept = swept_extent(wall, axis, until);
        // Sampled extremes miss the true ones by the square of a step.
        EXPECT_NEAR(swept.low, low, 1e-6) << axis << ' ' << until;
        EXPECT_NEAR(swept.high, high, 1e-6) << axis << ' ' << until;
      }
  }
  // A disc that turns about a diameter sweeps a ball of its radius.
  wall.geometry = dem_gpu::Disc{{0, 0, 0}, {0, 0, 1}, 0.1};
  wall.motion = {};
  wall.motion.angular_velocity = {1, 0, 0};
  EXPECT_NEAR(swept_extent(wall, 2, 10).high, 0.1, 2e-4) << "the polygon about the rim";
  EXPECT_GE(swept_extent(wall, 2, 10).high, 0.1);
  EXPECT_DOUBLE_EQ(extent_at_start(wall, 2).high, 0);
}

TEST(PeriodicCheck, RefusesAnOutflowAlongAPeriodicAxis) {
  expect_refused([](Scene& s) { s.outflow = dem_gpu::Outflow{{1, 0, 0}, -1}; }, {"outflow", "leans towards x"});
  EXPECT_EQ(refusal([](Scene& s) { s.outflow = dem_gpu::Outflow{{0, 0, 1}, -1}; }), "accepted");
}

TEST(PeriodicCheck, RefusesBodiesThatOverlapAcrossAFace) {
  const auto across = [](Real gap) {
    return [gap](Scene& s) {
      s.bodies[0].position = {0.005, 0.005, 0.05};
      s.bodies[1].position = {0.065 - gap, 0.005, 0.05};
    };
  };
  EXPECT_EQ(refusal(across(0.0001)), "accepted");
  const auto without_a_box = [](Scene& s) {
    s.periodic.reset();
    s.bodies[0].position = {0.085, 0.005, 0.05};
    s.bodies[1].position = {0.069, 0.005, 0.05};
  };
  EXPECT_EQ(refusal(across(-0.004)), refusal(without_a_box));
  expect_refused(across(-0.004), {"body 0 and body 1 overlap at the start"});
  expect_refused(
      [](Scene& s) {
        s.bodies[0].position = {0.001, 0.001, 0.05};
        s.bodies[1].position = {0.07, 0.07, 0.05};
      },
      {"body 0 and body 1 overlap at the start"});
}

TEST(PeriodicStart, EnergyOfContactsAcrossAFaceIsCounted) {
  // Two balls 1 % of a diameter deep in one another across an edge: k d^2 / 2.
  Scene scene = empty_scene(1, 0);
  scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
  scene.periodic = periodic_box({-0.05, 0, 0}, {0.1, 0.1, 0.1});
  const Real half = 0.5 * 0.0198 / std::sqrt(Real(2));
  scene.bodies = {body_at(0, {-0.05 + half, 0.1 - half, 0.05}), body_at(0, {0.05 - half, half, 0.05})};
  dem_gpu::Simulation simulation(scene);
  const Real energy = 0.5 * 1e5 * 0.0002 * 0.0002;
  EXPECT_NEAR(simulation.ledger().initial, energy, 1e-9 * energy);
  simulation.advance(5000);
  EXPECT_TRUE(simulation.snapshot().contacts.empty());
  // What the integrator keeps of a free elastic contact at 20 steps.
  EXPECT_NEAR(simulation.ledger().kinetic, energy, 1e-2 * energy);
}

TEST(PeriodicRun, NamesOwnersNotGhosts) {
  // A ball shot through a larger one across a face: the contact is far too soft.
  Scene scene = empty_scene(0.5, 0);
  scene.shapes = {dem_gpu::sphere_shape("large", 0.01), dem_gpu::sphere_shape("small", 0.004)};
  scene.sphere_law = dem_gpu::LinearSpring{0.1};
  scene.periodic = periodic_box({0, 0, 0}, {0.08, 0.08, 0}, "xy");
  scene.bodies = {body_at(0, {0.001, 0.04, 0.05}), body_at(1, {0.06, 0.04, 0.05}, {}, {3, 0, 0})};
  scene.run.time_step = 1e-4;
  dem_gpu::Simulation simulation(scene);
  bool meets_across = false;
  try {
    for (int step = 0; step < 400; ++step) {
      simulation.advance(1);
      for (const auto& contact : simulation.snapshot().contacts) {
        EXPECT_EQ(contact.body_a, 0);
        EXPECT_EQ(contact.body_b, 1);
        meets_across = true;
      }
    }
    FAIL() << "must stop";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("body 0 and body 1 have sunk"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(meets_across);
}

}  // namespace
