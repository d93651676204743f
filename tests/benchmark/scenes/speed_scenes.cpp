// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/speed_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "tests/benchmark/scenes/hull_part.h"
#include "tests/benchmark/scenes/placing.h"
#include "tests/benchmark/scenes/scene_parts.h"
#include "tests/benchmark/scenes/solids.h"

namespace benchmark_scenes {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;

constexpr int kSpheres = 10000, kMixed = 1000, kOutlet = 500, kMillCubes = 1500, kRocks = 1000;
constexpr double kSphereDiameter = 0.01;  // [m]
constexpr double kRockDiameter = 0.01;    // of the sphere of its volume [m]
constexpr double kSphereStep = 1e-4;      // [s]
constexpr double kMillSpeed = 5.661;      // [rad/s]
constexpr int kMillLifters = 8;
constexpr double kMillPassage = 2 * std::numbers::pi / kMillLifters / kMillSpeed;  // from one lifter to the next [s]
constexpr double kJitter = 2e-4;                                                   // of the lattices [m]

int count_of(const SceneOptions& options, int own) { return options.bodies > 0 ? options.bodies : own; }

/// Bodies of the scene's shapes in turn on the lattice, `attitude` drawing the orientation of each.
template <class Attitude>
void add_bodies(Scene& scene, Lattice lattice, int count, const Attitude& attitude) {
  std::mt19937_64 random(20241);
  lattice.jitter = kJitter;
  for (const Vec3& site : lattice_sites(lattice, count, random)) {
    dem_gpu::Body body;
    body.shape = static_cast<int>(scene.bodies.size() % scene.shapes.size());
    body.position = site;
    body.orientation = attitude(random);
    scene.bodies.push_back(body);
  }
}

double largest_reach(const Scene& scene) {
  double reach = 0;
  for (const dem_gpu::Shape& shape : scene.shapes) reach = std::max(reach, bounding_radius(shape));
  return reach;
}

/// Sites of a drum nearer to its axis than `inner`; bodies reach out by `reach` along the axes of the lattice [m].
Lattice in_drum(const Drum& drum, double reach, double inner) {
  Lattice lattice{{-drum.radius, -drum.length / 2, -drum.radius}, 2 * drum.radius, drum.length, reach};
  lattice.is_free = [inner](const Vec3& site) { return std::hypot(site.x, site.z) < inner - 2 * kJitter; };
  return lattice;
}

Scene sphere_scene(const std::string& name, const SceneOptions& options) {
  Scene scene = empty_scene(name, 0.5, options);
  scene.shapes = {dem_gpu::sphere_shape("sphere", kSphereDiameter / 2)};
  scene.sphere_law = dem_gpu::Hertz{};  // of a material's own 5 MPa and 0.3
  scene.run.time_step = kSphereStep;
  return scene;
}

dem_gpu::Quaternion upright(std::mt19937_64&) { return {}; }

/// A floor of four blocks round a square hole in the middle, and a block that closes it until the outlet opens.
void add_floor_with_gate(Scene& scene, double width, double hole) {
  const double low = (width - hole) / 2, high = (width + hole) / 2;
  const double beyond = 0.02, thickness = 0.02;  // [m]
  const auto add = [&](const std::string& name, const Vec3& from, const Vec3& to) {
    add_wall(scene, name, dem_gpu::VolumeObject{box_between(from + Vec3{0, 0, -thickness}, to)});
  };
  add("floor left", {-beyond, -beyond, 0}, {low, width + beyond, 0});
  add("floor right", {high, -beyond, 0}, {width + beyond, width + beyond, 0});
  add("floor front", {low, -beyond, 0}, {high, low, 0});
  add("floor back", {low, high, 0}, {high, width + beyond, 0});
  add("gate", {low, low, 0}, {high, high, 0});
  scene.walls.back().removed_at = kOutletOpens;
}

template <int parts>
Scene rock_hopper_of(const SceneOptions& options) {
  return rock_hopper(options, parts);
}
template <int parts>
Scene rock_mill_of(const SceneOptions& options) {
  return rock_mill(options, parts);
}

}  // namespace

Scene sphere_box(const SceneOptions& options) {
  Scene scene = sphere_scene("S1 box", options);
  const double width = 0.2 * growth(options.bodies, kSpheres, 2);
  add_sides(scene, width);
  add_floor(scene);
  add_bodies(scene, {{}, width, width, kSphereDiameter / 2}, count_of(options, kSpheres), upright);
  return scene;
}

Scene sphere_drum(const SceneOptions& options) {
  Scene scene = sphere_scene("S1 drum", options);
  const double size = growth(options.bodies, kSpheres, 3);
  const Drum drum{0.15 * size, 0.3 * size, 30 * 2 * std::numbers::pi / 60, false};
  add_drum(scene, drum);
  add_bodies(scene, in_drum(drum, kSphereDiameter / 2, drum.radius - kSphereDiameter / 2), count_of(options, kSpheres),
             upright);
  return scene;
}

Scene mixed_box(const SceneOptions& options) {
  Scene scene = empty_scene("S2", 0.3, options);
  scene.shapes = {cube(0.01), truncated_tetrahedron(1e-6)};
  const double width = 0.12 * growth(options.bodies, kMixed, 2);
  add_sides(scene, width);
  add_floor(scene);
  add_bodies(scene, {{}, width, width, largest_reach(scene)}, count_of(options, kMixed), random_rotation);
  set_polyhedral_law(scene, options, 2, 0.02);
  return scene;
}

Scene outlet_box(const SceneOptions& options) {
  Scene scene = empty_scene("S3", 0.3, options);
  scene.shapes = {three_cube_l(0.008), four_part_cross(0.008)};
  const double size = growth(options.bodies, kOutlet, 2);
  add_sides(scene, 0.16 * size);
  add_floor_with_gate(scene, 0.16 * size, 0.08 * size);
  scene.outflow = dem_gpu::Outflow{{0, 0, 1}, -0.1};
  add_bodies(scene, {{}, 0.16 * size, 0.16 * size, largest_reach(scene)}, count_of(options, kOutlet), random_rotation);
  set_polyhedral_law(scene, options, 2, 0.02);
  return scene;
}

Scene cube_mill(const SceneOptions& options) {
  Scene scene = empty_scene("S4", 0.3, options);
  scene.shapes = {cube(0.01)};
  const double size = growth(options.bodies, kMillCubes, 3);
  const Drum drum{0.15 * size, 0.14 * size, kMillSpeed / std::sqrt(size)};
  const Lifters lifters{kMillLifters, 0.015, 0.015};
  add_drum(scene, drum);
  add_lifters(scene, drum, lifters);
  // Nearly upright, since 1,500 at random attitudes do not find room apart from each other.
  constexpr double kTilt = 0.15;  // [rad]
  const double reach = 0.005 * (1 + std::numbers::sqrt2 * kTilt);
  const double inner = drum.radius - lifters.height - reach * std::numbers::sqrt2;
  add_bodies(scene, in_drum(drum, reach, inner), count_of(options, kMillCubes),
             [](std::mt19937_64& random) { return random_tilt(random, kTilt); });
  set_polyhedral_law(scene, options, 1.5, 0.02);
  return scene;
}

Scene rock_hopper(const SceneOptions& options, int parts) {
  Scene scene = empty_scene("S5 hopper, rocks of " + std::to_string(parts) + " parts", 0.3, options);
  scene.shapes = {rough_rock(parts, kRockDiameter, 1), rough_rock(parts, kRockDiameter, 2)};
  const double size = growth(options.bodies, kRocks, 3);
  const double radius = 0.07 * size, outlet = 0.03 * size, slope = radius - outlet;  // at 45 degrees
  add_wall(scene, "cone", dem_gpu::Cone{{}, {0, 0, 1}, slope, outlet, radius});
  add_wall(scene, "shell", dem_gpu::Cylinder{{0, 0, slope}, {0, 0, 1}, 4 * radius, radius});
  add_wall(scene, "gate", dem_gpu::Disc{{}, {0, 0, 1}, outlet});
  scene.walls.back().removed_at = kHopperOpens;
  scene.outflow = dem_gpu::Outflow{{0, 0, 1}, -0.05};
  const double reach = largest_reach(scene), inner = radius - reach - 2 * kJitter;
  Lattice lattice{{-radius, -radius, slope}, 2 * radius, 2 * radius, reach};
  lattice.is_free = [inner](const Vec3& site) { return std::hypot(site.x, site.y) < inner; };
  add_bodies(scene, lattice, count_of(options, kRocks), random_rotation);
  set_polyhedral_law(scene, options, 1.5 * std::sqrt(size), 0.02);
  return scene;
}

Scene rock_mill(const SceneOptions& options, int parts) {
  Scene scene = empty_scene("S5 mill, rocks of " + std::to_string(parts) + " parts", 0.3, options);
  scene.shapes = {rough_rock(parts, kRockDiameter, 1), rough_rock(parts, kRockDiameter, 2)};
  const double size = growth(options.bodies, kRocks, 3);
  const double radius = 0.12 * size;
  const Drum drum{radius, radius, 0.7 * std::sqrt(9.81 / radius)};
  const Lifters lifters{8, 0.1 * radius, 0.1 * radius};
  add_drum(scene, drum);
  add_lifters(scene, drum, lifters);
  const double reach = largest_reach(scene);
  add_bodies(scene, in_drum(drum, reach, radius - lifters.height - reach), count_of(options, kRocks), random_rotation);
  set_polyhedral_law(scene, options, 1.5 * std::sqrt(size), 0.02);
  return scene;
}

const std::vector<SpeedScene>& speed_scenes() {
  static const std::vector<SpeedScene> all{{"s1-box", sphere_box, false, 0.2, 0.6},
                                           {"s1-drum", sphere_drum, false, 0.2, 0.6},
                                           {"s2", mixed_box, true, 0.25, 1.2},
                                           {"s3", outlet_box, true, 0.3, kOutletOpens},
                                           {"s4", cube_mill, true, kMillPassage, 16 * kMillPassage},
                                           {"hopper-4", rock_hopper_of<4>, true, kHopperOpens / 2, kHopperOpens},
                                           {"hopper-8", rock_hopper_of<8>, true, kHopperOpens / 2, kHopperOpens},
                                           {"mill-4", rock_mill_of<4>, true, 0.25, 1},
                                           {"mill-8", rock_mill_of<8>, true, 0.25, 1}};
  return all;
}

const SpeedScene& speed_scene(const std::string& name) {
  std::vector<std::string> known;
  for (const SpeedScene& scene : speed_scenes()) {
    if (scene.name == name) return scene;
    known.push_back(scene.name);
  }
  throw catalog::UsageError("no scene '" + name + "'; " + catalog::word_hint(name, known));
}

}  // namespace benchmark_scenes
