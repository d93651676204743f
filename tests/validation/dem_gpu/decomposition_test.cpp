// SPDX-License-Identifier: Apache-2.0
// A body cut into more parts moves the same.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"
#include "tests/support/non_convex_bodies.h"
#include "tests/support/pair_integrals.h"

namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;

Vec3 corner(const dem_gpu::Snapshot& snapshot, int body) {
  return snapshot.position[body] + rotate(snapshot.orientation[body], {kEdge, kEdge, kEdge});
}

/// Falls on a plane, a slab and another cube of the same cut, with friction and damping.
dem_gpu::Snapshot drop(const dem_gpu::Shape& shape, const Quaternion& attitude, int ground) {
  Scene scene = empty_scene(0.6, 0.3);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.gravity = {0, 0, -9.81};
  scene.shapes = {shape};
  if (ground == 0) scene.walls = {floor_wall()};
  if (ground == 1) scene.walls = {slab_wall()};
  scene.bodies = {body_at(0, {0.001, 0.002, 0.0185}, attitude, {0.1, 0.05, -0.5})};
  if (ground == 2) {
    scene.walls = {floor_wall()};
    scene.bodies[0].position.z += kEdge;
    scene.bodies.push_back(body_at(0, {0, 0, kEdge / 2}));
  }
  scene.run.time_step = 2e-5;
  Simulation simulation(scene);
  simulation.advance(1500);
  return simulation.snapshot();
}

TEST(DecompositionInvariance, CubeOfOneTwoAndEightParts) {
  const std::array<int, 3> cuts[] = {{1, 1, 1}, {2, 1, 1}, {2, 2, 2}};
  struct Attitude {
    const char* name;
    Quaternion orientation;
  };
  const Attitude attitudes[] = {{"flat", {}},
                                {"edge", edge_down()},
                                {"vertex", vertex_down()},
                                {"oblique", dem_gpu::axis_angle({0.6, 0, 0.8}, 0.4)}};
  const char* grounds[] = {"plane", "slab", "cube"};
  for (int ground = 0; ground < 3; ++ground)
    for (const Attitude& attitude : attitudes) {
      const auto whole = drop(box_shape({kEdge, kEdge, kEdge}), attitude.orientation, ground);
      double worst = 0;
      for (const auto& cut : cuts)
        worst =
            std::max(worst, norm(corner(drop(box_shape({kEdge, kEdge, kEdge}, cut), attitude.orientation, ground), 0) -
                                 corner(whole, 0)));
      std::printf("  cube of 1, 2, 8 parts, %-7s on %-5s: paths within %.1e of the edge\n", attitude.name,
                  grounds[ground], worst / kEdge);
      EXPECT_LT(worst, (1e-9 + kSingle.path) * kEdge) << attitude.name << " on " << grounds[ground];
    }
}

TEST(DecompositionInvariance, LCutInTwoWays) {
  const std::array<std::vector<Real>, 3> cuts{{{0, kEdge, 2 * kEdge}, {0, kEdge, 2 * kEdge}, {0, kEdge}}};
  const auto three = dem_gpu::polyhedral_shape("L3", grid_parts({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, cuts));
  const std::array<std::vector<Real>, 3> finer{
      {{0, kEdge / 2, kEdge, 2 * kEdge}, {0, kEdge, 2 * kEdge}, {0, kEdge / 2, kEdge}}};
  std::vector<std::array<int, 3>> cells;
  for (int z = 0; z < 2; ++z)
    for (const auto& cell : {std::array<int, 2>{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}})
      cells.push_back({cell[0], cell[1], z});
  const auto ten = dem_gpu::polyhedral_shape("L10", grid_parts(cells, finer));
  EXPECT_NEAR(three.volume / ten.volume, 1, 1e-12);
  const auto fall = [&](const dem_gpu::Shape& shape, bool on_block) {
    Scene scene = empty_scene(0.6, 0.3);
    scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
    scene.gravity = {0, 0, -9.81};
    scene.shapes = {shape, box_shape({0.8 * kEdge, 0.8 * kEdge, 0.8 * kEdge})};
    scene.walls = {floor_wall()};
    scene.bodies = {body_at(0, {0, 0, 1.2 * kEdge}, dem_gpu::axis_angle({0.6, 0, 0.8}, 0.7), {0.1, 0, -0.5})};
    if (on_block) scene.bodies.push_back(body_at(1, {0, 0, 0.4 * kEdge}));
    if (on_block) scene.bodies[0].position.z += 0.8 * kEdge;
    scene.run.time_step = 2e-5;
    Simulation simulation(scene);
    simulation.advance(1500);
    return corner(simulation.snapshot(), 0);
  };
  const double on_plane = norm(fall(three, false) - fall(ten, false)) / kEdge;
  const double on_block = norm(fall(three, true) - fall(ten, true)) / kEdge;
  std::printf("  L of 3 and 10 parts: on a plane within %.1e of the edge, on a block %.1e\n", on_plane, on_block);
  EXPECT_LT(on_plane, 1e-9 + kSingle.path);
  EXPECT_LT(on_block, 1e-9 + kSingle.path);
}

TEST(DecompositionInvariance, CubeSlidesOverASeam) {
  // A frictionless probe over a block of 1 part and of 32 parts: the same path, no side force (Jolt
  // DiscreteCubeSlideMesh).
  const auto slide = [](std::array<int, 3> cut, std::array<int, 3> probe_cut) {
    Scene scene = empty_scene(0.5, 0);
    scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
    scene.gravity = {0, 0, -9.81};
    scene.shapes = {box_shape({0.2, 0.2, 0.05}, cut), box_shape({kEdge, kEdge, kEdge}, probe_cut)};
    scene.walls = {floor_wall()};
    const Real mass = 2500 * 8e-6, sunk = mass * 9.81 / (2e8 * kEdge * kEdge);
    scene.bodies = {body_at(0, {0, 0, 0.025 - 2500 * 0.002 * 9.81 / (2e8 * 0.04)}),
                    body_at(1, {-0.08, 0.003, 0.05 + kEdge / 2 - sunk}, {}, {0.3, 0, 0})};
    Simulation simulation(scene);
    run_to(simulation, 0.4);
    return simulation.snapshot();
  };
  const auto whole = slide({1, 1, 1}, {1, 1, 1}), cut = slide({4, 4, 2}, {2, 2, 2});
  EXPECT_NEAR(cut.velocity[1].x, 0.3, 1e-4);
  EXPECT_LT(norm(cut.position[1] - whole.position[1]), (1e-9 + kSingle.path) * kEdge);
  // The probe rings on its contact at 2000 rad/s.
  EXPECT_LT(norm(cut.velocity[1] - whole.velocity[1]), 1e-9 + kSingle.path * kEdge * 2000);
}

/// Two cuts of one body.
struct TwoCuts {
  const char* name;
  Parts one, other;
  Vec3 centre;  // of the body [m]
};

std::vector<TwoCuts> cut_twice() {
  return {{"cube in 27 and 1", cut_box({2, 2, 2}, {3, 3, 3}), cut_box({2, 2, 2}, {1, 1, 1}), {0, 0, 0}},
          {"L in 2 and 3", l_in_2(), l_in_3(), {1, 1, 0.5}},
          {"L in 6 and 3", l_in_6(), l_in_3(), {1, 1, 0.5}},
          {"cross in 3 and 5", cross_in_3(), cross_in_5(), {1.5, 1.5, 0.5}},
          {"U in 3 and 5", u_in_3(), u_in_5(), {1.5, 1.5, 0.5}},
          {"slanted T in 3 and 6", slanted_t(false), slanted_t(true), {0, 1.3, 0.5}},
          {"hexapod in 7 and 9", hexapod(), hexapod_cut_otherwise(), {0, 0, 0}},
          {"rock in 32 and 64", star_rock(bumpy_radius, 1, false), star_rock(bumpy_radius, 1, true), {0, 0, 0}}};
}

/// Worst change of force and torque from one cut to the other, over those of the one.
double worst_change(const PairIntegrals& one, const PairIntegrals& other, const Placed& a, const Placed& b) {
  const auto first = one.of<dem_gpu::DepthIntegrals>(a, b), second = other.of<dem_gpu::DepthIntegrals>(a, b);
  EXPECT_FALSE(first.is_truncated || second.is_truncated);
  const double force = norm(first.force);
  // Grazing: below a ten thousandth of a flat contact's, or too little to be known to kSingle.relative.
  if (!(force > 1e-6 + (kIsMixed ? kSingle.integral / kSingle.relative : 0))) return 0;
  return std::max(norm(first.force - second.force), norm(first.moment - second.moment)) / force;
}

TEST(DecompositionInvariance, ForceOnANonConvexBodyCutInTwoWays) {
  // A cube, and the body itself, pushed into the body from all sides: corners, notches and arms, up to 0.2 deep and
  // through. Rounding only: the two cuts add the same pieces in another order.
  for (const TwoCuts& body : cut_twice()) {
    const PairIntegrals cube_one(body.one, {unit_cube()}, 0.15), cube_other(body.other, {unit_cube()}, 0.15);
    const PairIntegrals self_one(body.one, body.one, 0.15), self_other(body.other, body.other, 0.15);
    std::mt19937 random(9);
    double against_cube = 0, against_itself = 0;
    int touching = 0;
    for (int i = 0; i < 300; ++i) {
      const Placed cube{body.centre + std::uniform_real_distribution<double>(0, 2)(random) * random_direction(random),
                        random_rotation(random)};
      touching += norm(cube_one.of<dem_gpu::DepthIntegrals>({}, cube).force) > 1e-6;
      against_cube = std::max(against_cube, worst_change(cube_one, cube_other, {}, cube));
      if (i >= 60) continue;
      const Placed same{std::uniform_real_distribution<double>(1, 2.5)(random) * random_direction(random),
                        random_rotation(random)};
      against_itself = std::max(against_itself, worst_change(self_one, self_other, {}, same));
    }
    std::printf("  %-20s force and torque change by %.1e against a cube (%d touch), %.1e against itself\n", body.name,
                against_cube, touching, against_itself);
    EXPECT_GT(touching, 100) << body.name;
    EXPECT_LT(against_cube, 1e-10 + kSingle.relative) << body.name;
    EXPECT_LT(against_itself, 1e-10 + kSingle.relative) << body.name;
  }
}

/// Turns a body's principal axes back to the frame its parts are given in.
Quaternion body_frame(const Parts& parts) {
  catalog::VolumeMoments moments;
  for (const catalog::ConvexPart& part : parts) moments += catalog::volume_moments(triangulated(part));
  const auto axes = catalog::mass_properties(moments).principal_axes;  // rows: the axes in the parts' frame
  const Vec3 x = to_vec3(axes[0]), y = to_vec3(axes[1]);
  // First x to its place, then y about it.
  const Quaternion first = turn_between({1, 0, 0}, x);
  const Vec3 turned = rotate(first, {0, 1, 0});
  return dem_gpu::axis_angle(x, std::atan2(dot(cross(turned, y), x), dot(turned, y))) * first;
}

TEST(DecompositionInvariance, HookedUsHold) {
  // Two Us, each astride the other's base with a play of 0.2, drawn into each other without friction: they hold by
  // their shape, whatever the cut, and never pass through. Alone they would be four edges past each other by the end.
  const Parts coarse = boxes_body({{{0, 0, 0}, {3.2, 1, 1}}, {{0, 1, 0}, {1, 3, 1}}, {{2.2, 1, 0}, {3.2, 3, 1}}});
  const Parts fine = boxes_body({{{0, 0, 0}, {1, 2, 1}},
                                 {{0, 2, 0}, {1, 3, 1}},
                                 {{1, 0, 0}, {2.2, 1, 1}},
                                 {{2.2, 0, 0}, {3.2, 1.5, 1}},
                                 {{2.2, 1.5, 0}, {3.2, 3, 1}}});
  const auto pull = [](const Parts& parts) {
    Scene scene = empty_scene(0.5, 0);
    scene.polyhedral_law = dem_gpu::DepthPotential{4e6};
    scene.shapes = {dem_gpu::polyhedral_shape("U", parts)};
    // The first opens upwards and its base strikes that of the second, which opens downwards across it.
    const Real base = (3.2 * 0.5 + 4 * 2) / 7.2;  // height of the centre over the base's outer side
    const Quaternion upright = body_frame(parts);
    const Quaternion across = dem_gpu::axis_angle({0, 1, 0}, std::numbers::pi / 2) *
                              dem_gpu::axis_angle({0, 0, 1}, std::numbers::pi) * upright;
    scene.bodies = {body_at(0, {0, base, 0}, upright, {0, 1, 0}),
                    body_at(0, {0.05, 2.05 - base, 0.03}, across, {0, -1, 0})};
    scene.run.steps_per_contact = 40;
    Simulation simulation(scene);
    const Real start = scene.bodies[0].position.y - scene.bodies[1].position.y;
    Real rise = 0;
    while (simulation.time() < 2) {
      run_to(simulation, simulation.time() + 0.05);
      const auto now = simulation.snapshot();
      rise = std::max(rise, now.position[0].y - now.position[1].y - start);
    }
    EXPECT_LT(simulation.quality().largest_overlap, 0.05);
    EXPECT_GT(rise, 0.04) << "they came to touch";
    EXPECT_LT(rise, 0.3) << "the gap of 0.05, and what their play lets them tilt";
    return simulation.snapshot().position[0];
  };
  EXPECT_LT(norm(pull(coarse) - pull(fine)), 1e-9 + 3 * kSingle.path) << "bodies three long";
}

}  // namespace
