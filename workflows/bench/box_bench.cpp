// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Scene;
using dem_gpu::Vec3;

constexpr int kBodies = 200;
constexpr double kRadius = 0.01;              // of the balls [m]
constexpr double kEdge = 0.016;               // of the cubes, whose volume is about a ball's [m]
constexpr double kSpeed = 1;                  // of each body at the start [m/s]
constexpr double kSphereStiffness = 1e5;      // [N/m]
constexpr double kPolyhedralStiffness = 1e9;  // [N/m3]
constexpr double kModulus = 1e8;              // of Hertz contacts [Pa]

struct Box {
  std::string name;
  bool has_cubes;
  bool is_hertz;
  double steps_per_contact;
  std::int64_t collisions;
  double pitch;  // between bodies at the start [m]
};

/// Frictionless elastic bodies that fly about in a closed room.
Scene box_scene(const Box& box) {
  Scene scene;
  scene.name = box.name;
  scene.gravity = {};
  scene.materials = {{"grain", 2500, kModulus, 0.3}};
  scene.contact = {{{1, 0}}};
  scene.friction.reset();
  scene.shapes = {dem_gpu::sphere_shape("ball", kRadius),
                  dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({kEdge, kEdge, kEdge})})};
  scene.sphere_law = dem_gpu::LinearSpring{kSphereStiffness};
  if (box.is_hertz) scene.sphere_law = dem_gpu::Hertz{};
  scene.polyhedral_law = dem_gpu::DepthPotential{kPolyhedralStiffness};
  constexpr int kAcross = 6;
  std::mt19937_64 random(200);
  for (int i = 0; i < kBodies; ++i) {
    dem_gpu::Body body;
    body.shape = box.has_cubes && i % 2;
    body.position = box.pitch * Vec3{i % kAcross + 0.5, i / kAcross % kAcross + 0.5, i / (kAcross * kAcross) + 0.5};
    body.orientation = random_rotation(random);
    const Vec3 direction = rotate(random_rotation(random), Vec3{0, 0, 1});
    body.velocity = kSpeed * direction;
    scene.bodies.push_back(body);
  }
  const double width = kAcross * box.pitch;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_far : {false, true}) {
      dem_gpu::Wall wall;
      wall.name = std::string(is_far ? "far " : "near ") + "xyz"[axis];
      const double sign = is_far ? -1 : 1;
      const Vec3 normal{axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
      wall.geometry = dem_gpu::Plane{is_far ? width * Vec3{1, 1, 1} : Vec3{}, normal};
      scene.walls.push_back(wall);
    }
  scene.run.steps_per_contact = box.steps_per_contact;
  return scene;
}

/// Counts contacts that begin, looking often enough to miss none.
class CollisionCount {
 public:
  void look(const dem_gpu::Simulation& simulation) {
    std::set<std::pair<int, int>> now;
    for (const auto& contact : simulation.snapshot().contacts) {
      now.insert({contact.body_a, contact.body_b});
      count_ += !before_.contains({contact.body_a, contact.body_b});
    }
    before_ = std::move(now);
  }
  std::int64_t count() const { return count_; }

 private:
  std::set<std::pair<int, int>> before_;
  std::int64_t count_ = 0;
};

CaseResult measure_box(const Box& box) {
  const Scene scene = box_scene(box);
  dem_gpu::Simulation simulation(scene);
  const auto mass = simulation.geometry().body_mass;
  // Of the bodies, and what the walls owe them: the second half of the last step's kick, which the impulses on the
  // walls count already.
  const auto momentum = [&] {
    const auto now = simulation.snapshot();
    Vec3 sum;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * now.velocity[i];
    for (const auto& contact : now.contacts)
      if (contact.body_b < 0) sum += simulation.time_step() / 2 * contact.force;
    return sum;
  };
  const Vec3 momentum_before = momentum();
  double scale = 0;  // sum of m |v| [kg m/s]
  for (const double m : mass) scale += m * kSpeed;

  const auto look_every = static_cast<std::int64_t>(box.steps_per_contact / 4);
  CollisionCount collisions;
  Vec3 on_walls;        // impulse [N s]
  double taken_at = 0;  // [s]
  const WallClock clock;
  double largest_error = 0;
  while (collisions.count() < box.collisions) {
    simulation.advance(look_every);
    collisions.look(simulation);
    if (simulation.step() % (1000 * look_every) != 0 && collisions.count() < box.collisions) continue;
    const auto ledger = simulation.ledger();
    largest_error = std::max(largest_error, std::abs(ledger.imbalance() / ledger.initial));
    for (const auto& load : simulation.take_wall_loads()) on_walls += (simulation.time() - taken_at) * load.force;
    taken_at = simulation.time();
  }
  const auto ledger = simulation.ledger();
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<double> bound) {
    Figure figure{name, value, unit, {}, ""};
    if (bound) figure.goal = at_most(*bound);
    result.figures.push_back(figure);
  };
  add("energy error at the end, of the total", std::abs(ledger.imbalance() / ledger.initial), "-", 1e-6);
  add("energy error, largest", largest_error, "-", {});
  add("momentum error with the walls' impulse, of the sum of m v",
      norm(momentum() + on_walls - momentum_before) / scale, "-", 1e-10);
  add("collisions", static_cast<double>(collisions.count()), "-", {});
  add("simulated time", simulation.time(), "s", {});
  add("steps", static_cast<double>(simulation.step()), "-", {});
  add("wall time", clock.seconds(), "s", {});
  return result;
}

}  // namespace

BenchPlan plan_box_bench(const BenchOptions&) {
  BenchPlan plan;
  // Dilute: three bodies that meet at once cost far more accuracy than pairs. A pitch is more than a cube's diagonal.
  // While bodies touch, the energy of Verlet's steps swings by a share of the square of the step; it comes back as they
  // part. So the short cases, each with half the step of the last, show what the long ones end with.
  constexpr double kDilute = 0.06, kDense = 0.03;
  for (const Box& box :
       {Box{"spheres-short-80", false, false, 80, 500, kDilute}, Box{"spheres-160", false, false, 160, 100000, kDilute},
        Box{"spheres-dense-40", false, false, 40, 5000, kDense},
        Box{"spheres-dense-640", false, false, 640, 100000, kDense},
        Box{"hertz-short-40", false, true, 40, 3000, kDense}, Box{"hertz-short-80", false, true, 80, 3000, kDense},
        Box{"hertz-short-160", false, true, 160, 3000, kDense},
        Box{"hertz-dense-480", false, true, 480, 100000, kDense}, Box{"mix-short-40", true, false, 40, 2000, kDense},
        Box{"mix-short-80", true, false, 80, 2000, kDense}, Box{"mix-dense-320", true, false, 320, 100000, kDense}})
    plan.cases.push_back({box.name, [box] { return measure_box(box); }});
  return plan;
}

}  // namespace workflows
