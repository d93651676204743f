// SPDX-License-Identifier: Apache-2.0
// Objects welded together are one solid: their flush seams are not felt, and in the hollow edge between them both hold.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/dem_runs.h"
#include "tests/support/precision.h"

namespace {

using namespace test_support;
using Walls = std::vector<dem_gpu::Wall>;

constexpr Real kSize = 0.02;  // of the bodies [m]

dem_gpu::Wall block(const std::string& name, const Vec3& low, const Vec3& high) {
  dem_gpu::Wall wall;
  wall.name = name;
  wall.geometry = dem_gpu::VolumeObject{moved_part(dem_gpu::box_part(high - low), {}, Real(0.5) * (low + high))};
  return wall;
}

/// The plane z = 0 as blocks.
Walls two_blocks() {
  return {block("left", {-0.1, -0.1, -0.05}, {0, 0.1, 0}), block("right", {0, -0.1, -0.05}, {0.1, 0.1, 0})};
}
Walls tiles() {
  Walls walls;
  for (int i = -4; i < 4; ++i)
    for (int j = -4; j < 4; ++j)
      walls.push_back(block("tile " + std::to_string(i) + "," + std::to_string(j), {0.025 * i, 0.025 * j, -0.05},
                            {0.025 * (i + 1), 0.025 * (j + 1), 0}));
  return walls;
}
Walls slab_in_a_plane() { return {floor_wall("floor"), block("slab", {-0.01, -0.02, -0.05}, {0.01, 0.02, 0})}; }

/// A sphere or cube that starts pressed in by its weight, from (-0.03, y) along (1, slope).
dem_gpu::Scene slide_scene(bool is_sphere, Real friction, Real y, Real slope) {
  dem_gpu::Scene scene = empty_scene(0.5, friction);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e9};
  scene.sphere_law = dem_gpu::LinearSpring{1e5};
  scene.shapes = {is_sphere ? dem_gpu::sphere_shape("ball", kSize / 2) : box_shape({kSize, kSize, kSize})};
  const Real weight = scene.materials[0].density * scene.shapes[0].volume * 9.81;
  const Real sunk = weight / (is_sphere ? 1e5 : 2e9 * kSize * kSize);
  scene.bodies = {body_at(0, {-0.03, y, kSize / 2 - sunk}, {}, {0.5, 0.5 * slope, 0})};
  scene.run.time_step = 1e-5;
  return scene;
}

struct Track {
  std::vector<Vec3> position, turn;
  double imbalance = 0;  // of the ledger, over throughput
};

Track track(dem_gpu::Scene scene, const Walls& walls) {
  scene.walls = walls;
  dem_gpu::Simulation simulation(scene);
  Track result;
  for (int i = 0; i < 120; ++i) {
    simulation.advance(100);
    const auto snapshot = simulation.snapshot();
    const Quaternion& q = snapshot.orientation[0];
    result.position.push_back(snapshot.position[0]);
    result.turn.push_back({q.x, q.y, q.z});
  }
  const auto ledger = simulation.ledger();
  result.imbalance = std::abs(ledger.imbalance()) / ledger.throughput;
  return result;
}

/// Largest distance over size, turning included.
Real deviation(const Track& a, const Track& b) {
  Real largest = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    largest = std::max({largest, norm(a.position[i] - b.position[i]) / kSize, norm(a.turn[i] - b.turn[i])});
  return largest;
}

struct NamedFloor {
  const char* name;
  Walls walls;
};

TEST(Welded, ASphereDoesNotFeelSeams) {
  const NamedFloor floors[] = {
      {"two blocks", two_blocks()}, {"64 tiles", tiles()}, {"a slab in a plane", slab_in_a_plane()}};
  for (const Real friction : {0., 0.3})
    for (const Real slope : {0., 1 / 3.}) {  // straight across, or aslant over the corners of the tiles
      const dem_gpu::Scene scene = slide_scene(true, friction, slope > 0 ? -0.01 : 0.0, slope);
      const Track plane = track(scene, {floor_wall()});
      EXPECT_GT(plane.position.back().x, friction > 0 ? 0.005 : 0.025) << "past the seam";
      for (const NamedFloor& floor : floors) {
        const Track seams = track(scene, floor.walls);
        std::printf("  sphere, friction %.1f, over %-17s off the plane by %.1e of its size\n", friction, floor.name,
                    deviation(seams, plane));
        // The nearest point of the common solid is the plane's but for rounding, and the contact keeps its springs.
        EXPECT_LT(deviation(seams, plane), 1e-12) << floor.name;
        EXPECT_LT(seams.imbalance, plane.imbalance + 1e-10) << floor.name;
      }
    }
}

TEST(Welded, ACubeSlidesOverSeams) {
  const Walls one_block{block("one", {-0.1, -0.1, -0.05}, {0.1, 0.1, 0})};
  for (const Real friction : {0., 0.3})
    for (const Real slope : {0., 1 / 3.}) {
      const dem_gpu::Scene scene = slide_scene(false, friction, slope > 0 ? -0.01 : 0.0, slope);
      const Track whole = track(scene, one_block);
      EXPECT_GT(whole.position.back().x, friction > 0 ? 0.005 : 0.025);
      const Real over_two = deviation(track(scene, two_blocks()), whole),
                 over_tiles = deviation(track(scene, tiles()), whole);
      std::printf("  cube, friction %.1f, off its path over one block: two blocks %.1e, 64 tiles %.1e of its size\n",
                  friction, over_two, over_tiles);
      // The pieces' elastic forces add up to the whole's. With friction each piece winds up springs of its own, over a
      // slip of the overlap's order, 1e-5 of the size.
      EXPECT_LT(over_two, friction > 0 ? 1e-5 : 1e-6);
      // A step that ends while the cube's front stands less than its overlap beyond a seam finds the damper of the new
      // contact aslant, and loses 1e-4 of the speed at that seam.
      EXPECT_LT(over_tiles, 5e-4);
    }
}

/// A floor at z = 0 and a step that stands on it, its foot sunk in, with its face at x = 0.03.
Walls floor_and_step() {
  return {block("floor", {-0.1, -0.1, -0.05}, {0.1, 0.1, 0}), block("step", {0.03, -0.1, -0.02}, {0.06, 0.1, 0.04})};
}

TEST(Welded, TheFootOfAStepStopsWithBothWalls) {
  const Real speed = 0.5, restitution = 0.5;
  for (const bool is_sphere : {true, false}) {
    dem_gpu::Scene scene = slide_scene(is_sphere, 0, 0, 0);
    scene.walls = floor_and_step();
    dem_gpu::Simulation simulation(scene);
    simulation.advance(16000);  // 0.16 s: 0.1 s to the step
    const auto loads = simulation.take_wall_loads();
    const auto end = simulation.snapshot();
    const Real mass = scene.materials[0].density * scene.shapes[0].volume;
    std::printf("  %s at the foot: thrown back at %.5f of the speed, floor carries %.5f of the weight\n",
                is_sphere ? "sphere" : "cube", -end.velocity[0].x / speed, -loads[0].force.z / (mass * 9.81));
    EXPECT_NEAR(-end.velocity[0].x / speed, restitution, is_sphere ? 0.001 : 0.015);  // as on a plane
    EXPECT_NEAR(loads[0].force.z, -mass * 9.81, 1e-3 * mass * 9.81);
    EXPECT_NEAR(loads[1].force.x * 0.16, mass * (speed - end.velocity[0].x), 1e-6 * mass * speed) << "momentum";
    EXPECT_LT(std::abs(loads[0].force.x) + std::abs(loads[1].force.z), 1e-4 * mass * 9.81);
    if (!is_sphere) continue;
    Walls planes{floor_wall("floor"), floor_wall("step")};
    planes[1].geometry = dem_gpu::Plane{{0.03, 0, 0}, {-1, 0, 0}};
    EXPECT_LT(deviation(track(scene, floor_and_step()), track(scene, planes)), 1e-12 + kSingle.position);
  }
}

TEST(Welded, AShellAndItsLifterHoldABodyBetweenThem) {
  const Real radius = 0.1, angle = 0.6;  // of the lifter from the lowest point [rad]
  const Vec3 outward{std::sin(angle), 0, -std::cos(angle)};
  dem_gpu::Wall shell, lifter;
  shell.name = "shell";
  shell.geometry = dem_gpu::Cylinder{{0, -0.1, 0}, {0, 1, 0}, 0.2, radius};
  lifter.name = "lifter";
  lifter.geometry = dem_gpu::VolumeObject{
      moved_part(dem_gpu::box_part({0.02, 0.18, 0.06}), dem_gpu::axis_angle({0, 1, 0}, -angle), radius * outward)};
  for (const bool is_sphere : {true, false}) {
    dem_gpu::Scene scene = slide_scene(is_sphere, 0.3, 0, 0);
    scene.walls = {shell, lifter};
    const Real start = 1.1;  // beyond the lifter, so that it slides down on it
    scene.bodies = {
        body_at(0, 0.084 * Vec3{std::sin(start), 0, -std::cos(start)}, dem_gpu::axis_angle({0, 1, 0}, -start))};
    dem_gpu::Simulation simulation(scene);
    simulation.advance(100000);
    simulation.take_wall_loads();
    simulation.advance(1000);
    const auto loads = simulation.take_wall_loads();
    const auto end = simulation.snapshot();
    const Real weight = scene.materials[0].density * scene.shapes[0].volume * 9.81;
    std::printf("  %s: shell carries %.3f, lifter %.3f of the weight\n", is_sphere ? "sphere" : "cube",
                norm(loads[0].force) / weight, norm(loads[1].force) / weight);
    EXPECT_LT(norm(end.velocity[0]), 1e-5) << "at rest";
    EXPECT_LT(norm(loads[0].force + loads[1].force + Vec3{0, 0, weight}), 1e-3 * weight);
    EXPECT_GT(norm(loads[0].force), 0.2 * weight);
    EXPECT_GT(norm(loads[1].force), 0.2 * weight);
    if (!is_sphere) continue;
    // The sphere lies in the corner: on the shell, and at the lifter's face, half the lifter's width and its own radius
    // from the lifter's middle plane.
    EXPECT_NEAR(norm(end.position[0]), radius - kSize / 2, 1e-3 * kSize);
    EXPECT_NEAR(dot(end.position[0], Vec3{std::cos(angle), 0, std::sin(angle)}), 0.01 + kSize / 2, 1e-3 * kSize);
  }
}

}  // namespace
