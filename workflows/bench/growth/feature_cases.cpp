// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/solids.h"
#include "workflows/bench/growth/beds.h"
#include "workflows/bench/growth/grid_mesh.h"
#include "workflows/bench/growth/growth_cases.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;
using Change = std::function<void(Scene&)>;

struct Feature {
  std::string name;
  std::string scene;  // of the bed
  Change turn_on;     // from a bed without friction and ledger
};

void add_cube_above(Scene& scene) {
  dem_gpu::Body body;
  body.shape = static_cast<int>(scene.shapes.size());
  scene.shapes.push_back(benchmark_scenes::cube(0.01));
  scene.polyhedral_law = benchmark_scenes::mixed_box({}).polyhedral_law;
  scene.run.time_step = std::min(scene.run.time_step, dem_gpu::time_step(benchmark_scenes::mixed_box({})));
  double top = 0;
  for (const dem_gpu::Body& other : scene.bodies) top = std::max(top, other.position.z);
  body.position = {0.05, 0.05, top + 0.03};
  scene.bodies.push_back(body);
}

void make_two_sizes(Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); i += 2) scene.bodies[i].scale = 0.98;
  for (std::size_t i = 1; i < scene.bodies.size(); i += 2) scene.bodies[i].scale = 1.02;
}

std::vector<Feature> features() {
  const Change friction = [](Scene& scene) { scene.friction = dem_gpu::Friction{}; };
  const Change ledger = [](Scene& scene) { scene.energy_ledger = true; };
  return {{"spheres: friction and its history", "s1-box", friction},
          {"spheres: energy ledger", "s1-box", ledger},
          {"spheres: one polyhedron among them", "s1-box", add_cube_above},
          {"spheres: floor a mesh of 200 triangles", "s1-box", [](Scene& scene) { make_floor_a_mesh(scene, 10); }},
          {"spheres: two sizes", "s1-box", make_two_sizes},
          {"polyhedra: friction and its history", "s2", friction},
          {"polyhedra: energy ledger", "s2", ledger},
          {"polyhedra: floor a mesh of 200 triangles", "s2", [](Scene& scene) { make_floor_a_mesh(scene, 10); }}};
}

/// Frictionless, without a ledger.
Scene plain_bed(const std::string& scene) {
  Scene plain = bed({scene, benchmark_scenes::Law::depth_potential, 2});
  plain.friction.reset();
  plain.energy_ledger = false;
  return plain;
}

std::string passes_of(const Scene& scene) {
  std::string names;
  for (const std::string& name : dem_gpu::Simulation(scene).pass_names()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void add_plain(CaseResult& result, const std::string& name, const Scene& plain, const BedCost& cost) {
  result.figures.push_back(
      {name + ", " + dem_gpu::kPrecision + " precision: nothing on", cost.particle_step(), "ns", {}, ""});
  result.figures.push_back({name + ": passes (" + passes_of(plain) + ")",
                            static_cast<double>(dem_gpu::Simulation(plain).pass_names().size()),
                            "-",
                            {},
                            ""});
}

}  // namespace

CaseResult measure_features() {
  CaseResult result;
  const Scene spheres = plain_bed("s1-box"), polyhedra = plain_bed("s2");
  const BedCost of_spheres = cost_of(spheres), of_polyhedra = cost_of(polyhedra);
  add_plain(result, "spheres", spheres, of_spheres);
  add_plain(result, "polyhedra", polyhedra, of_polyhedra);
  for (const Feature& feature : features()) {
    const bool has_spheres = feature.scene == "s1-box";
    Scene scene = has_spheres ? spheres : polyhedra;
    feature.turn_on(scene);
    const BedCost cost = cost_of(scene), &base = has_spheres ? of_spheres : of_polyhedra;
    result.figures.push_back({feature.name, cost.particle_step(), "ns", {}, ""});
    result.figures.push_back(
        {feature.name + ", over nothing on", cost.particle_step() / base.particle_step(), "-", {}, ""});
    result.figures.push_back(
        {feature.name + ": memory of a particle, over nothing on", cost.memory / base.memory, "-", {}, ""});
  }
  return result;
}

}  // namespace workflows
