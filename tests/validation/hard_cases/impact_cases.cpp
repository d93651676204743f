// SPDX-License-Identifier: Apache-2.0
// One or two bodies in motion.
#include <algorithm>
#include <cmath>

#include "tests/support/dem_runs.h"
#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {
namespace {

using namespace test_support;
using dem_gpu::Scene;
using dem_gpu::Simulation;

constexpr Real kEdge = 0.02;

Scene falling(Real restitution, Real friction) {
  Scene scene = empty_scene(restitution, friction);
  scene.gravity = {0, 0, -9.81};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e8};
  scene.walls = {floor_wall()};
  scene.shapes = {box_shape({kEdge, kEdge, kEdge})};
  return scene;
}

/// A frictionless cube slides at 3 m/s over ten flush blocks (Jolt, ActiveEdgesTests).
Finding internal_edges() {
  Scene scene = falling(0.5, 0);
  scene.shapes = {box_shape({kEdge, kEdge, kEdge}), box_shape({0.4, 0.1, 0.02}, {10, 2, 1})};
  scene.walls.clear();
  const Real sunk = 2500 * kEdge * 9.81 / 2e8;
  scene.bodies = {body_at(0, {-0.15, 0.003, 0.02 + kEdge / 2 - 0.01 - sunk}, {}, {3, 0, 0}), body_at(1, {0, 0, 0})};
  scene.bodies[1].is_fixed = true;
  Simulation simulation(scene);
  run_to(simulation, 0.1);
  const auto now = simulation.snapshot();
  const Vec3 expected = scene.bodies[0].position + Vec3{3 * simulation.time(), 0, 0};
  const double path = norm(now.position[0] - expected), speed = norm(now.velocity[0] - Vec3{3, 0, 0});
  return {path < 1e-5 && speed < 1e-4, text("position off by %.1e m, velocity by %.1e m/s", path, speed)};
}

/// A cube thrown on a floor, bouncing and sliding; everything shifted by `far`.
Vec3 thrown(const Vec3& far) {
  Scene scene = falling(0.4, 0.3);
  std::get<dem_gpu::Plane>(scene.walls[0].geometry).point = far;
  scene.bodies = {body_at(0, far + Vec3{0, 0, 0.03}, dem_gpu::axis_angle({0.6, 0.8, 0}, 0.2), {0.5, 0.1, -0.5})};
  scene.run.time_step = 2e-5;
  Simulation simulation(scene);
  simulation.advance(15000);
  return simulation.snapshot().position[0] - far;
}

Finding far_from_origin() {
  const Real far = 1e6 * kEdge;
  const double apart = norm(thrown({far, -far, far}) - thrown({})) / kEdge;
  return {apart < 1e-3, text("0.3 s of bounce and slide: paths %.1e edges apart", apart)};
}

Finding fast_body() {
  Scene scene = falling(1, 0);
  scene.gravity = {};
  scene.shapes.push_back(box_shape({0.2, 0.2, 0.004}));
  scene.walls.clear();
  scene.bodies = {body_at(0, {0, 0, 0.05}, {}, {0, 0, -200}), body_at(1, {})};
  scene.bodies[1].is_fixed = true;
  std::get<dem_gpu::DepthPotential>(scene.polyhedral_law).stiffness = dem_gpu::stiffness_for_overlap(scene, 200, 0.02);
  Simulation simulation(scene);
  const Impact impact = run_impact(simulation);
  const double restitution = simulation.snapshot().velocity[0].z / 200;
  return {std::abs(restitution - 1) < 1e-3, text("comes back at %.5f of 200 m/s, overlap %.2g of the plate",
                                                 restitution, impact.largest_overlap / 0.004)};
}

/// Restitution got from one impact: a cube flat on a floor, a sphere on a sphere.
Real rebound(Scene scene, Real approach) {
  scene.gravity = {};
  scene.run.steps_per_contact = dem_gpu::promise_of(dem_gpu::Preset::reference).steps_per_contact;
  Simulation simulation(scene);
  run_impact(simulation);
  const auto now = simulation.snapshot();
  const Vec3 second = now.velocity.size() > 1 ? now.velocity[1] : Vec3{};
  return (now.velocity[0].z - second.z) / approach;
}

Finding restitution_sweep() {
  struct Worst {
    Real error = 0, at = 0;
    void take(Real got, Real asked) {
      if (std::abs(got - asked) > error) error = std::abs(got - asked), at = asked;
    }
  } face, linear, hertz;
  for (const Real e : {0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    Scene cube = falling(e, 0);
    cube.bodies = {body_at(0, {0, 0, 0.011}, {}, {0, 0, -1})};
    face.take(rebound(cube, 1), e);
    Scene spheres = falling(e, 0);
    spheres.walls.clear();
    spheres.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
    spheres.bodies = {body_at(0, {0, 0, 0.021}, {}, {0, 0, -0.5}), body_at(0, {}, {}, {0, 0, 0.5})};
    linear.take(rebound(spheres, 1), e);
    spheres.sphere_law = dem_gpu::Hertz{};
    hertz.take(rebound(spheres, 1), e);
  }
  return {std::max({face.error, linear.error, hertz.error}) < 0.01,
          text("worst error: cube's face %.1e at %.2f, spheres linear %.1e at %.2f, Hertz %.1e at %.2f", face.error,
               face.at, linear.error, linear.at, hertz.error, hertz.at)};
}

/// Largest energy (kinetic and stored) of an elastic, frictional graze above what it began with.
double energy_gained(Scene scene) {
  scene.gravity = {};
  scene.run.steps_per_contact = 40;
  Simulation simulation(scene);
  const double before = simulation.ledger().initial;
  double most = 0;
  bool has_touched = false;
  for (int i = 0; i < 200000; ++i) {
    simulation.advance(1);
    const auto ledger = simulation.ledger();
    most = std::max(most, (ledger.kinetic + ledger.elastic_normal + ledger.elastic_tangential) / before - 1);
    const bool touches = simulation.bulk().contacts > 0;
    if (has_touched && !touches) break;
    has_touched |= touches;
  }
  return most;
}

Finding grazing() {
  double cubes = 0, balls = 0;
  for (const Real degrees : {45.0, 70.0, 80.0, 85.0, 89.0}) {
    const Real angle = degrees * M_PI / 180;
    Scene scene = falling(1, 0.5);
    const Vec3 velocity{std::sin(angle), 0, -std::cos(angle)};
    scene.bodies = {body_at(0, {0, 0, 0.0175}, vertex_down(), velocity)};
    cubes = std::max(cubes, energy_gained(scene));
    scene.shapes = {dem_gpu::sphere_shape("ball", 0.01)};
    scene.bodies = {body_at(0, {0, 0, 0.0101}, {}, velocity)};
    balls = std::max(balls, energy_gained(scene));
  }
  // The integrator's own swing of the energy within a contact, at 40 steps.
  return {std::max(cubes, balls) < 1e-3, text("largest rise: cube's corner %.1e, sphere %.1e", cubes, balls)};
}

/// A small body falls on a large one of a hundred times its size.
Finding size_ratio(bool is_sphere) {
  Scene scene = falling(0.3, 0.5);
  scene.shapes = {box_shape({0.1, 0.1, 0.1}), box_shape({0.001, 0.001, 0.001}), dem_gpu::sphere_shape("grain", 0.0005)};
  scene.sphere_law = dem_gpu::LinearSpring{100};
  const Real sunk = 2500 * 0.1 * 9.81 / 2e8;
  scene.bodies = {body_at(0, {0, 0, 0.05 - sunk}), body_at(is_sphere ? 2 : 1, {0.01, 0.02, 0.1012})};
  Simulation simulation(scene);
  run_to(simulation, 0.1);
  const auto now = simulation.snapshot();
  const auto ledger = simulation.ledger();
  const double height = now.position[1].z - 0.1 - 0.0005, speed = norm(now.velocity[1]);
  const double drift = std::hypot(now.position[1].x - 0.01, now.position[1].y - 0.02);
  return {std::abs(height) < 5e-5 && speed < 1e-3 && drift < 1e-6 &&
              std::abs(ledger.imbalance()) < 1e-3 * ledger.throughput,
          text("rests %.1e m off the face at %.1e m/s, drift %.1e m, energy off by %.1e", height, speed, drift,
               std::abs(ledger.imbalance()) / ledger.throughput)};
}

/// A cube of 20 kg stands on one of 20 mg: the light one carries it, sunk in by M g / (2 k A) on either side, and is
/// not thrown out. (Damping goes by the light one's mass, so that the heavy one would swing for long if dropped.)
Finding mass_ratio() {
  Scene scene = falling(0.3, 0.5);
  scene.materials = {{"foam", 2.5}, {"lead", 2.5e6}};
  scene.contact.assign(2, {{0.3, 0.5}, {0.3, 0.5}});
  const Real area = kEdge * kEdge, load = 2.5e6 * kEdge * area * 9.81, stiffness = 1.2e9;
  scene.polyhedral_law = dem_gpu::DepthPotential{stiffness};
  const Real sunk = load / (2 * stiffness * area);
  scene.bodies = {body_at(0, {0, 0, kEdge / 2 - sunk}), body_at(0, {0, 0, 1.5 * kEdge - 2 * sunk})};
  scene.bodies[1].material = 1;
  Simulation simulation(scene);
  run_to(simulation, 0.3);
  const auto now = simulation.snapshot();
  const double light = (now.position[0].z - (kEdge / 2 - sunk)) / sunk;
  const double heavy = (now.position[1].z - (1.5 * kEdge - 2 * sunk)) / sunk;
  return {std::abs(light) < 0.1 && std::abs(heavy) < 0.1,
          text("light one off by %.1e, heavy one by %.1e of the overlap", light, heavy)};
}

/// A needle of aspect 45 at 1000 rad/s about a cross axis and 50 about its own, free.
Finding spinning_needle() {
  Scene scene = empty_scene(1, 0);
  scene.shapes = {box_shape({0.004, 0.004, 0.18})};
  scene.bodies = {body_at(0, {})};
  scene.bodies[0].angular_velocity = {1000, 0, 50};
  scene.run.time_step = 5e-6;
  Simulation simulation(scene);
  const double before = simulation.ledger().kinetic;
  const auto momentum = [&] {
    const auto now = simulation.snapshot();
    const Vec3 spin = rotate_back(now.orientation[0], now.angular_velocity[0]);
    return rotate(now.orientation[0], hadamard(scene.shapes[0].principal_inertia, spin));
  };
  const Vec3 start = momentum();
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    simulation.advance(10000);
    worst = std::max(worst, std::abs(simulation.ledger().kinetic / before - 1));
  }
  const double turned = norm(momentum() - start) / norm(start);
  return {worst < 1e-5 && turned < 1e-10,
          text("1 s, 160 turns: energy within %.1e, angular momentum %.1e", worst, turned)};
}

/// The same needle whirls 30 mm above a floor and falls on it aslant: tips strike at up to 90 m/s.
Finding needle_on_a_floor() {
  Scene scene = falling(0.5, 0.3);
  scene.shapes = {box_shape({0.004, 0.004, 0.18})};
  scene.bodies = {body_at(0, {0, 0, 0.12}, dem_gpu::axis_angle({0, 1, 0}, 1.2))};
  scene.bodies[0].angular_velocity = {0, 0, 1000};
  scene.polyhedral_law = dem_gpu::DepthPotential{1e11};
  Simulation simulation(scene);
  run_to(simulation, 0.3);
  const auto ledger = simulation.ledger();
  const double share = std::abs(ledger.imbalance()) / ledger.throughput;
  const double lowest = simulation.snapshot().position[0].z;
  return {share < 0.01 && lowest > 0, text("0.3 s: energy off by %.1e, largest overlap %.2g of the diameter", share,
                                           simulation.quality().largest_overlap)};
}

}  // namespace

std::vector<HardCase> impact_cases() {
  return {
      {"slide over internal edges", "position to 1e-5 m, velocity to 1e-4 m/s", true, internal_edges},
      {"a million sizes from the origin", "path within 1e-3 edges of the one at the origin", true, far_from_origin},
      {"fast body on a thin plate", "thrown back to 1e-3", true, fast_body},
      {"restitution 0.05 .. 1", "within 0.01 at preset reference", true, restitution_sweep},
      {"grazing friction", "adds no energy (rise below 1e-3)", true, grazing},
      {"size ratio 1 to 100, cube on cube", "comes to rest, energy to 1e-3", true, [] { return size_ratio(false); }},
      {"size ratio 1 to 100, sphere on cube", "comes to rest, energy to 1e-3", true, [] { return size_ratio(true); }},
      {"mass ratio 1e6, heavy on light", "light one stays, overlaps to 10 %", true, mass_ratio},
      {"needle at 1000 rad/s, free", "energy to 1e-5, angular momentum to 1e-10", true, spinning_needle},
      {"needle at 1000 rad/s on a floor", "energy to 1 %, stays above the floor", true, needle_on_a_floor}};
}

}  // namespace hard_cases
