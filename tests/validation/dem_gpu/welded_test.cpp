// SPDX-License-Identifier: Apache-2.0
// Objects welded together are one solid: their flush seams are not felt, and in the hollow edge between them both hold.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/dem_runs.h"

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

void print_split(const Track& a, const Track& b) {
  Real x=0,y=0,z=0,t=0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    const Vec3 d = a.position[i]-b.position[i];
    x=std::max(x,std::abs(d.x)/kSize); y=std::max(y,std::abs(d.y)/kSize); z=std::max(z,std::abs(d.z)/kSize); t=std::max(t,norm(a.turn[i]-b.turn[i]));
  }
  std::printf("     x %.1e y %.1e z %.1e turn %.1e\n",x,y,z,t);
}
struct NamedFloor {
  const char* name;
  Walls walls;
};

TEST(Welded, SeamsOfFlushBlocksAreNotFelt) {
  const NamedFloor floors[] = {
      {"one block", {block("one", {-0.1, -0.1, -0.05}, {0.1, 0.1, 0})}}, {"two blocks", two_blocks()}, {"64 tiles", tiles()}, {"slab in a plane", slab_in_a_plane()}};
  for (const bool is_sphere : {true, false})
    for (const Real friction : {0., 0.3})
      for (const Real slope : {0., 1 / 3.}) {  // straight across, or aslant; over the corners of the tiles
        const dem_gpu::Scene scene = slide_scene(is_sphere, friction, slope > 0 ? -0.01 : 0.0, slope);
        const Track plane = track(scene, {floor_wall()});
        for (const NamedFloor& floor : floors) {
          const Track seams = track(scene, floor.walls);
          std::printf("  %-6s mu %.1f slope %.1f over %-16s off the plane %.1e, imbalance %.1e (%.1e)\n",
                      is_sphere ? "sphere" : "cube", friction, slope, floor.name, deviation(seams, plane),
                      seams.imbalance, plane.imbalance);
          print_split(seams, plane);
          EXPECT_LT(deviation(seams, plane), 1e-6) << floor.name;
        }
      }
}

}  // namespace
