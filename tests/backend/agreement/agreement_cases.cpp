// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/agreement/agreement_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "dem_gpu/simulation.h"
#include "tests/benchmark/scenes/placing.h"
#include "tests/benchmark/scenes/resumed_scene.h"
#include "tests/benchmark/scenes/speed_scenes.h"

namespace agreement {
namespace {

using benchmark_scenes::Law;
using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;

constexpr double kBulkTime = 0.06;  // bodies move on by about their size [s]
constexpr int kSamples = 30;        // over the later half

benchmark_scenes::SceneOptions options(int bodies, Law law = Law::depth_potential) {
  benchmark_scenes::SceneOptions result;
  result.bodies = bodies;
  result.law = law;
  return result;
}

std::int64_t steps_in(double time, const Simulation& simulation) {
  return std::max<std::int64_t>(1, std::llround(time / simulation.time_step()));
}

/// Time of two passages of the mill's lifters [s].
double two_passages(const Scene& mill) {
  int lifters = 0;
  double speed = 0;
  for (const dem_gpu::Wall& wall : mill.walls) {
    if (wall.contact_class != "lifter") continue;
    ++lifters;
    speed = norm(wall.motion.angular_velocity);
  }
  return 2 * 2 * std::numbers::pi / lifters / speed;
}

/// Of a body of scale 1.
struct Inertia {
  double mass;   // [kg]
  Vec3 moments;  // about its principal axes [kg m2]
};

std::vector<Inertia> inertia_of(const Scene& scene) {
  std::vector<Inertia> result;
  for (const dem_gpu::Body& body : scene.bodies) {
    const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
    const dem_gpu::Shape& shape = scene.shapes[static_cast<std::size_t>(body.shape)];
    result.push_back({density * shape.volume, density * shape.principal_inertia});
  }
  return result;
}

double coordination(const dem_gpu::Snapshot& snapshot) {
  std::set<std::pair<int, int>> touching;
  for (const dem_gpu::SnapshotContact& contact : snapshot.contacts)
    if (contact.body_b >= 0) touching.emplace(contact.body_a, contact.body_b);
  return 2.0 * static_cast<double>(touching.size()) / static_cast<double>(snapshot.position.size());
}

Bulk measured(const dem_gpu::Snapshot& snapshot, const std::vector<Inertia>& inertia) {
  Bulk result;
  double total = 0;
  for (std::size_t i = 0; i < inertia.size(); ++i) {
    const auto& [mass, moments] = inertia[i];
    const Vec3 spin = rotate(conjugate(snapshot.orientation[i]), snapshot.angular_velocity[i]);
    result.kinetic_energy +=
        0.5 * (mass * dot(snapshot.velocity[i], snapshot.velocity[i]) + dot(spin, hadamard(moments, spin)));
    result.mean_height += mass * snapshot.position[i].z;
    total += mass;
  }
  result.mean_height /= total;
  result.coordination = coordination(snapshot);
  return result;
}

}  // namespace

std::vector<Case> cases() {
  using namespace benchmark_scenes;
  const Scene mill = cube_mill(options(150));
  return {{"spheres", sphere_box(options(400))},  {"sphere drum", sphere_drum(options(300))},
          {"cubes", mixed_box(options(100))},     {"cubes, volume law", mixed_box(options(100, Law::overlap_volume))},
          {"crosses", outlet_box(options(60))},   {"crosses, volume law", outlet_box(options(60, Law::overlap_volume))},
          {"cube mill", mill, two_passages(mill)}};
}

dem_gpu::Snapshot settled(const Case& agreement_case) {
  Simulation simulation(agreement_case.scene);
  simulation.advance(steps_in(agreement_case.settling_time, simulation));
  return simulation.snapshot();
}

dem_gpu::Snapshot after_steps(const Case& agreement_case, const dem_gpu::Snapshot& start, int steps) {
  Simulation simulation(benchmark_scenes::resumed(agreement_case.scene, start));
  simulation.advance(steps);
  return simulation.snapshot();
}

Bulk bulk(const Case& agreement_case, const dem_gpu::Snapshot& start, std::uint64_t seed) {
  Scene scene = benchmark_scenes::resumed(agreement_case.scene, start);
  std::mt19937_64 random(seed);
  for (dem_gpu::Body& body : scene.bodies)
    for (double* const component : {&body.velocity.x, &body.velocity.y, &body.velocity.z})
      *component += benchmark_scenes::uniform(random, -kPush, kPush);
  const std::vector<Inertia> inertia = inertia_of(scene);
  Simulation simulation(scene);
  simulation.advance(steps_in(kBulkTime / 2, simulation));
  Bulk mean;
  for (int sample = 0; sample < kSamples; ++sample) {
    simulation.advance(steps_in(kBulkTime / 2 / kSamples, simulation));
    const Bulk now = measured(simulation.snapshot(), inertia);
    mean.kinetic_energy += now.kinetic_energy / kSamples;
    mean.mean_height += now.mean_height / kSamples;
    mean.coordination += now.coordination / kSamples;
  }
  return mean;
}

}  // namespace agreement
