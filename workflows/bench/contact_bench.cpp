// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>

#include "dem_gpu/simulation.h"
#include "workflows/bench/bench_registry.h"
#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

using dem_gpu::Body;
using dem_gpu::Quaternion;
using dem_gpu::Scene;
using dem_gpu::Vec3;

/// Impacts side by side in one scene, each at its own phase of the step: errors are root mean squares over them.
constexpr int kPhases = 32;
constexpr int kStepsPerContact[] = {5, 10, 20, 40, 80};
/// Steps per contact of the default preset; the goals stand there.
constexpr int kDefaultSteps = 20;
constexpr double kRestitution = 0.5;
/// Runs of each, for the median of the wall time.
constexpr int kRepeats = 3;

/// A single normal impact with a power law F = k d^n, whose motion without damping is known in closed form.
struct Impact {
  std::string name;
  Scene scene;                // shapes, materials, laws, walls; no bodies
  Quaternion attitude;        // at impact
  double touch_height = 0;    // of the centre above the plane, or between centres, when they touch [m]
  double speed = 0;           // of approach [m/s]
  double effective_mass = 0;  // [kg]
  double exponent = 1;        // n
  double stiffness = 0;       // k [N/m^n]
  bool has_two_bodies = false;

  /// Time from touch to release: d_max = ((n+1) m v^2 / (2 k))^(1/(n+1)), times c_n / v.
  double contact_time() const {
    const double power = 1 / (exponent + 1);
    const double depth = std::pow((exponent + 1) * effective_mass * speed * speed / (2 * stiffness), power);
    const double c = 2 * std::sqrt(std::numbers::pi) * std::tgamma(1 + power) / std::tgamma(0.5 + power);
    return c * depth / speed;
  }
};

Scene empty_scene(const dem_gpu::Shape& shape, double density) {
  Scene scene;
  scene.name = "impact";
  scene.gravity = {};
  scene.materials = {{"grain", density}};
  scene.contact = {{{1, 0}}};
  scene.shapes = {shape};
  scene.friction.reset();
  scene.energy_ledger = false;
  return scene;
}

void add_floor(Scene& scene, int material) {
  dem_gpu::Wall floor;
  floor.name = "floor";
  floor.geometry = dem_gpu::Plane{{}, {0, 0, 1}};
  floor.material = material;
  scene.walls.push_back(floor);
}

/// Cube of 20 mm, 2500 kg/m3, at 1 m/s; F = k V on a plane with k = 1e11 N/m3.
Impact cube_impact(const std::string& name, const Quaternion& attitude, double height, double exponent,
                   double overlap_factor) {
  const double edge = 0.02, density = 2500, stiffness = 1e11;
  Impact impact;
  impact.name = name;
  impact.scene = empty_scene(dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({edge, edge, edge})}), density);
  impact.scene.polyhedral_law = dem_gpu::DepthPotential{stiffness / 2};  // flat on flat: 2 k A d
  add_floor(impact.scene, 0);
  impact.attitude = attitude;
  impact.touch_height = height * edge;
  impact.speed = 1;
  impact.effective_mass = density * edge * edge * edge;
  impact.exponent = exponent;
  impact.stiffness = stiffness * overlap_factor * std::pow(edge, 3 - exponent);  // V = factor edge^(3-n) d^n
  return impact;
}

Impact linear_sphere() {
  const double radius = 0.01, density = 2500, stiffness = 1e5;
  Impact impact;
  impact.name = "sphere-linear";
  impact.scene = empty_scene(dem_gpu::sphere_shape("sphere", radius), density);
  impact.scene.sphere_law = dem_gpu::LinearSpring{stiffness};
  add_floor(impact.scene, 0);
  impact.touch_height = radius;
  impact.speed = 1;
  impact.effective_mass = density * impact.scene.shapes[0].volume;
  impact.stiffness = stiffness;
  return impact;
}

/// Chung & Ooi, Granular Matter 13 (2011) 643-656, test 1: two glass spheres at 10 m/s each.
Impact glass_spheres() {
  const double radius = 0.01, modulus = 48e9, poisson = 0.2;
  Impact impact;
  impact.name = "sphere-hertz-pair";
  impact.scene = empty_scene(dem_gpu::sphere_shape("sphere", radius), 2800);
  impact.scene.sphere_law = dem_gpu::Hertz{};
  impact.scene.materials[0].youngs_modulus = modulus;
  impact.scene.materials[0].poisson_ratio = poisson;
  impact.has_two_bodies = true;
  impact.touch_height = 2 * radius;
  impact.speed = 20;
  impact.effective_mass = 2800 * impact.scene.shapes[0].volume / 2;
  impact.exponent = 1.5;
  impact.stiffness = 4.0 / 3 * modulus / (2 * (1 - poisson * poisson)) * std::sqrt(radius / 2);
  return impact;
}

/// The same, test 2: an aluminium sphere on a rigid plane (here 1e6 times stiffer) at 0.2 m/s.
Impact aluminium_sphere() {
  const double radius = 0.1, modulus = 70e9, poisson = 0.3, rigid = 1e6;
  Impact impact;
  impact.name = "sphere-hertz-plane";
  impact.scene = empty_scene(dem_gpu::sphere_shape("sphere", radius), 2699);
  impact.scene.sphere_law = dem_gpu::Hertz{};
  impact.scene.materials = {{"aluminium", 2699, modulus, poisson}, {"rigid", 2699, rigid * modulus, poisson}};
  impact.scene.contact.assign(2, {2, {1, 0}});
  add_floor(impact.scene, 1);
  impact.touch_height = radius;
  impact.speed = 0.2;
  impact.effective_mass = 2699 * impact.scene.shapes[0].volume;
  impact.exponent = 1.5;
  impact.stiffness = 4.0 / 3 * modulus / ((1 - poisson * poisson) * (1 + 1 / rigid)) * std::sqrt(radius);
  return impact;
}

/// What a set of impacts at one step and one restitution came to.
struct Outcome {
  double restitution_error = kFailedRun;   // rms of rebound over approach speed, less the restitution asked for [-]
  double contact_time_error = kFailedRun;  // rms over the exact contact time [-]; without damping only
  double wall_time = kFailedRun;           // an impact [s]
  double steps_in_contact = kFailedRun;    // exact contact time over step [-]
  std::string failure;
};

/// Gap before the step that brings impact `phase` into contact, in steps of flight.
double flight_steps(int phase) { return 1.25 + (phase + 0.5) / kPhases; }

void place_bodies(const Impact& impact, Scene& scene) {
  const double spacing = 10 * impact.touch_height;
  for (int phase = 0; phase < kPhases; ++phase) {
    const double height = impact.touch_height + impact.speed * scene.run.time_step * flight_steps(phase);
    Body body;
    body.orientation = impact.attitude;
    body.position = {spacing * (phase % 8), spacing * (phase / 8), height};
    body.velocity = {0, 0, impact.has_two_bodies ? -impact.speed / 2 : -impact.speed};
    scene.bodies.push_back(body);
    if (!impact.has_two_bodies) continue;
    body.position.z = 0;
    body.velocity = -body.velocity;
    scene.bodies.push_back(body);
  }
}

Outcome read_rebounds(const Impact& impact, const dem_gpu::Simulation& simulation, double restitution) {
  const dem_gpu::Snapshot after = simulation.snapshot();
  const double contact_time = impact.contact_time(), step = simulation.time_step();
  double restitution_square = 0, time_square = 0;
  for (int phase = 0; phase < kPhases; ++phase) {
    const int body = impact.has_two_bodies ? 2 * phase : phase;
    const double height = after.position[body].z - (impact.has_two_bodies ? after.position[body + 1].z : 0);
    const double rebound = after.velocity[body].z - (impact.has_two_bodies ? after.velocity[body + 1].z : 0);
    if (!(rebound > 0) || !(height > impact.touch_height)) return {.failure = "no rebound"};
    restitution_square += std::pow(rebound / impact.speed - restitution, 2);
    // Both flights are free, so the time in contact is what they leave over: no rounding to whole steps.
    const double flight = flight_steps(phase) * step + (height - impact.touch_height) / rebound;
    time_square += std::pow((after.time - flight) / contact_time - 1, 2);
  }
  return {std::sqrt(restitution_square / kPhases), std::sqrt(time_square / kPhases), 0, contact_time / step, ""};
}

Outcome run_impacts(const Impact& impact, int steps_per_contact, double restitution) {
  try {
    Scene scene = impact.scene;
    for (auto& row : scene.contact)
      for (dem_gpu::ContactProperties& properties : row) properties.restitution = restitution;
    Scene placed = scene;  // the shortest contact is a property of the bodies, not of their places
    place_bodies(impact, placed);
    scene.run.time_step = dem_gpu::shortest_contact_time(placed) / steps_per_contact;
    place_bodies(impact, scene);
    // A damped contact lasts longer; twice the undamped time covers restitution 0.5 for every exponent here.
    const auto steps = static_cast<std::int64_t>(4 + 2.2 * impact.contact_time() / scene.run.time_step);
    std::array<double, kRepeats> wall_times;
    Outcome outcome;
    for (double& wall_time : wall_times) {
      dem_gpu::Simulation simulation(scene);
      const WallClock clock;
      simulation.advance(steps);
      wall_time = clock.seconds() / kPhases;
      outcome = read_rebounds(impact, simulation, restitution);
    }
    std::sort(wall_times.begin(), wall_times.end());
    outcome.wall_time = wall_times[kRepeats / 2];
    return outcome;
  } catch (const std::exception& error) {
    return {.failure = error.what()};
  }
}

CaseResult measure_impact(const Impact& impact) {
  CaseResult result;
  PlotCurve restitution{"restitution", impact.name + ", e = 1", {}, {}, {}},
      damped = restitution, contact_time{"contact_time", impact.name, {}, {}, {}};
  damped.label = impact.name + ", e = 0.5";
  for (const int steps : kStepsPerContact) {
    const std::string at = ", " + std::to_string(steps) + " steps";
    const Outcome elastic = run_impacts(impact, steps, 1), inelastic = run_impacts(impact, steps, kRestitution);
    const auto add = [&](const std::string& name, const Outcome& outcome, double value, const std::string& unit,
                         std::optional<double> bound) {
      Figure figure{name + at, value, unit, {}, outcome.failure};
      if (std::isnan(value)) figure.value.reset();
      if (bound && steps == kDefaultSteps) figure.goal = at_most(*bound);
      result.figures.push_back(figure);
    };
    add("restitution 1, error", elastic, elastic.restitution_error, "-", 0.01);
    add("restitution 0.5, error", inelastic, inelastic.restitution_error, "-", 0.01);
    add("contact time, relative error", elastic, elastic.contact_time_error, "-", 0.01);
    add("steps in this contact", elastic, elastic.steps_in_contact, "steps", {});
    add("wall time", elastic, 1e6 * elastic.wall_time, "us/impact", {});
    const auto draw = [&](PlotCurve& curve, const Outcome& outcome, double error) {
      curve.x.push_back(outcome.wall_time);
      curve.y.push_back(error);
      curve.point_names.push_back(std::to_string(steps) + " steps");
    };
    draw(restitution, elastic, elastic.restitution_error);
    draw(damped, inelastic, inelastic.restitution_error);
    draw(contact_time, elastic, elastic.contact_time_error);
  }
  damped.plot = "restitution_damped";
  result.curves = {restitution, damped, contact_time};
  return result;
}

std::vector<Impact> impacts() {
  const double root_half = std::sqrt(0.5), root_third = std::sqrt(0.75);
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Quaternion edge = dem_gpu::axis_angle(x, std::numbers::pi / 4);
  const Quaternion vertex =
      dem_gpu::axis_angle(y, std::atan(std::sqrt(2.0))) * dem_gpu::axis_angle(z, std::numbers::pi / 4);
  return {cube_impact("cube-face", {}, 0.5, 1, 1),
          cube_impact("cube-edge", edge, root_half, 2, 1),
          cube_impact("cube-vertex", vertex, root_third, 3, root_third),
          linear_sphere(),
          glass_spheres(),
          aluminium_sphere()};
}

}  // namespace

BenchPlan plan_contact_bench(const BenchOptions&) {
  BenchPlan plan;
  for (const Impact& impact : impacts())
    plan.cases.push_back({impact.name, [impact] { return measure_impact(impact); }});
  const std::string time = "wall time an impact [s]";
  plan.plots = {
      {"restitution", "Elastic impacts, 5 to 80 steps in the stiffest contact", time, "error of restitution [-]"},
      {"restitution_damped", "Impacts with restitution 0.5 asked for", time, "error of restitution [-]"},
      {"contact_time", "Elastic impacts, 5 to 80 steps in the stiffest contact", time,
       "relative error of contact time [-]"}};
  return plan;
}

}  // namespace workflows
