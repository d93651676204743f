// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/simulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "catalog/input_error.h"
#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/broad_phase/neighbour_list.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/io/checkpoint.h"
#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/periodic/ghosts.h"
#include "dem_gpu/shapes/least_width.h"
#include "dem_gpu/start/start_overlap.h"
#include "dem_gpu/step_builder.h"
#include "dem_gpu/walls/hidden_faces.h"
#include "dem_gpu/walls/wall_motion.h"

namespace dem_gpu {
namespace {

/// Skin of the neighbour list in mean body diameters.
constexpr Real kSkinShare = 0.1;

std::vector<Shape> shapes_with_objects(const Scene& scene) {
  std::vector<Shape> shapes = scene.shapes;
  for (std::size_t w = 0; w < scene.walls.size(); ++w)
    if (const auto* object = std::get_if<VolumeObject>(&scene.walls[w].geometry)) {
      // Volume objects stay in the world frame of time 0: their pose is their motion.
      Shape shape = polyhedral_shape(scene.walls[w].name, {object->part});
      shape.geometry = PolyhedralShape{{welded_part(scene, w)}};
      shapes.push_back(std::move(shape));
    }
  return shapes;
}

/// The volume law has no depth field.
std::optional<Real> depth_cap(const Scene& scene) {
  const DepthPotential* law = depth_potential(scene.polyhedral_law);
  return law ? std::optional(law->depth_cap) : std::nullopt;
}

MeshColumns mesh_columns(const Scene& scene, Real largest_radius) {
  HostMeshColumns columns;
  for (const Wall& wall : scene.walls)
    if (const auto* mesh = std::get_if<MeshObject>(&wall.geometry)) append_mesh(columns, *mesh, largest_radius);
  return make_mesh_columns(columns);
}

Real effective_modulus(const Material& a, const Material& b) {
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

/// Effective shear modulus: 1 / G* = sum of (2 - nu) / G, G = E / (2 (1 + nu)).
Real effective_shear_modulus(const Material& a, const Material& b) {
  const auto compliance = [](const Material& m) {
    return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.youngs_modulus;
  };
  return 1 / (compliance(a) + compliance(b));
}

/// Tangential over normal stiffness of sphere contacts; Hertz: 8 G* a over 2 E* a.
Real tangential_stiffness_ratio(const Scene& scene, const Material& a, const Material& b) {
  if (!std::holds_alternative<Hertz>(scene.sphere_law))
    return scene.friction ? scene.friction->tangential_stiffness_ratio : 0;
  return 4 * effective_shear_modulus(a, b) / effective_modulus(a, b);
}

std::vector<PairProperties> pair_properties(const Scene& scene) {
  const std::size_t n = scene.materials.size();
  const Real sphere_exponent = std::visit([](const auto& law) { return law.kExponent; }, scene.sphere_law);
  // Of tangent stiffness: damped_stiffness of a power law over it, its root.
  const Real of_tangent = std::sqrt(damped_stiffness(1, 1 / sphere_exponent));
  std::map<Real, Real> solved;
  std::vector<PairProperties> pairs(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const ContactProperties& contact = scene.contact[i][j];
      const Real restitution = contact.restitution;
      if (!solved.contains(restitution)) solved[restitution] = damping_ratio(restitution);
      const Material &a = scene.materials[i], &b = scene.materials[j];
      pairs[i * n + j] = {solved[restitution],
                          contact.friction_coefficient,
                          effective_modulus(a, b),
                          of_tangent * solved[restitution],
                          tangential_stiffness_ratio(scene, a, b),
                          contact.rolling_friction,
                          contact.adhesion};
    }
  return pairs;
}

void set_bodies(const Scene& scene, BodyConstants& constants, BodyColumns& columns) {
  const std::size_t n = scene.bodies.size();
  const HostShapeColumns shapes = make_host_shape_columns(scene.shapes, std::nullopt);
  std::vector<int> shape(n), material(n);
  std::vector<Real> scale(n), mass(n), radius(n), diameter(n), width(n);
  std::vector<Vec3> inertia(n), position(n), velocity(n), angular_velocity(n);
  std::vector<Quaternion> orientation(n);
  std::vector<Real> shape_width;
  for (const Shape& one : scene.shapes) shape_width.push_back(least_width(one));
  std::vector<char> active(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Body& body = scene.bodies[i];
    const ShapeRange& range = shapes.shapes[body.shape];
    const Real s = body.scale, density = scene.materials[body.material].density;
    shape[i] = body.shape;
    material[i] = body.material;
    scale[i] = s;
    mass[i] = density * range.volume * s * s * s;
    inertia[i] = (density * s * s * s * s * s) * range.inertia;
    radius[i] = s * range.bounding_radius;
    diameter[i] = s * range.equivalent_diameter;
    width[i] = s * shape_width[body.shape];
    active[i] = static_cast<char>(body.is_fixed ? BodyState::fixed : BodyState::moving);
    position[i] = body.position;
    orientation[i] = normalized(body.orientation);
    velocity[i] = body.velocity;
    angular_velocity[i] = rotate_back(orientation[i], body.angular_velocity);
  }
  assign(constants.shape, shape);
  assign(constants.material, material);
  assign(constants.scale, scale);
  assign(constants.mass, mass);
  assign(constants.inertia, inertia);
  assign(constants.bounding_radius, radius);
  assign(constants.diameter, diameter);
  assign(constants.least_width, width);
  assign(columns.active, active);
  assign(columns.position, position);
  assign(columns.orientation, orientation);
  assign(columns.velocity, velocity);
  assign(columns.angular_velocity, angular_velocity);
  for (DeviceVector<Vec3>* column :
       {&columns.force, &columns.torque, &columns.predicted_velocity, &columns.predicted_angular_velocity,
        &columns.mean_velocity, &columns.mean_angular_velocity, &columns.listed_position})
    column->assign(n, Vec3{});
  columns.listed_displacement.assign(n, Real(0));
  std::vector<Vec3> force(n);
  for (std::size_t i = 0; i < n; ++i) force[i] = mass[i] * scene.gravity;
  assign(columns.force, force);
}

void set_classes(const Scene& scene, Model& model) {
  model.classes = {"particle-particle"};
  for (const Wall& wall : scene.walls) {
    const std::string name = "particle-" + (wall.contact_class.empty() ? wall.name : wall.contact_class);
    auto found = std::find(model.classes.begin(), model.classes.end(), name);
    if (found == model.classes.end()) found = model.classes.insert(model.classes.end(), name);
    model.wall_class.push_back(static_cast<int>(found - model.classes.begin()));
  }
}

Model make_model(const Scene& scene, BodyColumns& columns) {
  Model model;
  model.scene = scene;
  model.shapes = make_shape_columns(shapes_with_objects(scene), depth_cap(scene));
  set_bodies(scene, model.bodies, columns);
  model.meshes = mesh_columns(scene, max_of(model.bodies.bounding_radius, Real(0)));
  model.features.has_meshes = !model.meshes.meshes.empty();
  assign(model.pairs, pair_properties(scene));
  model.material_count = static_cast<int>(scene.materials.size());
  for (const Body& body : scene.bodies)
    model.body_is_sphere.push_back(std::holds_alternative<SphereShape>(scene.shapes[body.shape].geometry));
  model.features.has_friction = scene.friction.has_value();
  model.features.has_ledger = scene.energy_ledger;
  model.features.has_walls = !scene.walls.empty();
  model.features.has_spheres =
      std::find(model.body_is_sphere.begin(), model.body_is_sphere.end(), 1) != model.body_is_sphere.end();
  model.features.has_polyhedra =
      std::find(model.body_is_sphere.begin(), model.body_is_sphere.end(), 0) != model.body_is_sphere.end();
  model.features.has_friction_couples =
      has_rolling_friction(scene) || (model.features.has_friction && model.features.has_polyhedra);
  model.time_step = time_step(scene);
  Real mean_diameter = 0;
  for (const Real diameter : to_host(model.bodies.diameter)) mean_diameter += diameter;
  model.skin = kSkinShare * mean_diameter / static_cast<Real>(scene.bodies.size());
  set_classes(scene, model);
  return model;
}

}  // namespace

struct Simulation::Engine {
  BodyColumns initial_bodies;
  Model model;
  State state;
  std::vector<std::unique_ptr<Pass>> passes;

  explicit Engine(const Scene& scene)
      : model(make_model(scene, initial_bodies)),
        state{0,
              std::move(initial_bodies),
              {},
              {},
              {},
              {},
              WallSet(scene, static_cast<int>(scene.shapes.size())),
              0,
              true,
              {},
              {}},
        passes(build_step(scene)) {
    if (model.features.has_spheres) state.walls.weld(welded_walls(scene));
    Accounts& accounts = state.accounts;
    accounts.loss_normal.assign(model.classes.size(), 0);
    accounts.loss_shear.assign(model.classes.size(), 0);
    accounts.wall_work.assign(scene.walls.size(), 0);
    accounts.wall_work_taken.assign(scene.walls.size(), 0);
    accounts.wall_impulse.assign(scene.walls.size(), Vec3{});
    accounts.wall_angular_impulse.assign(scene.walls.size(), Vec3{});
    if (scene.periodic) start_ghosts(model, state);
    const BodyEnergy energy = body_energy(model, state);
    accounts.initial_kinetic = energy.kinetic;
    accounts.initial_gravitational = energy.gravitational;
    find_forces();
    refuse_deep_start(model, state);
    refuse_fast_walls(model, state);
    if (model.features.has_ledger) accounts.initial_elastic = book_start_energy(model, state);
  }

  /// Contacts and forces at time 0, as a step of no length: the first half kick needs them.
  void find_forces() {
    const Real time_step = std::exchange(model.time_step, Real(0));
    for (const auto& pass : passes)
      if (pass->finds_forces()) pass->run(model, state);
    model.time_step = time_step;
  }

  void refuse_truncated_polygons() const {
    const auto truncated = to_host(state.contacts.is_truncated);
    for (std::size_t c = 0; c < truncated.size(); ++c)
      if (truncated[c]) {
        const ContactKey key = state.contacts.key[c];
        throw std::runtime_error(
            "step " + std::to_string(state.step) + ": the overlap of body " + std::to_string(key_body_a(key)) +
            " with " + std::to_string(GhostOwners(model, state).owner(key_body_b(key))) +
            " has a face of more corners, or of more depths, than the engine holds; use a level with fewer vertices");
      }
  }
};

Simulation::Simulation(const Scene& scene) {
  check(scene);
  engine_ = std::make_unique<Engine>(scene);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::advance(std::int64_t steps) {
  for (std::int64_t i = 0; i < steps; ++i)
    for (const auto& pass : engine_->passes) pass->run(engine_->model, engine_->state);
  engine_->state.accounts.wall_load_time += static_cast<double>(steps) * engine_->model.time_step;
  engine_->refuse_truncated_polygons();
}

void Simulation::push(int body, const Vec3& impulse, const Vec3& angular_impulse) {
  const Model& model = engine_->model;
  BodyColumns& bodies = engine_->state.bodies;
  if (body < 0 || body >= static_cast<int>(bodies.position.size()))
    throw catalog::InputError("push: there is no body " + std::to_string(body) + "; the scene has " +
                              std::to_string(bodies.position.size()) + ", counted from 0");
  const double before = body_energy(model, engine_->state).kinetic;
  const std::size_t i = static_cast<std::size_t>(body);
  const Vec3 turn = rotate_back(bodies.orientation[i], angular_impulse), inertia = model.bodies.inertia[i];
  bodies.velocity[i] = Vec3(bodies.velocity[i]) + impulse / model.bodies.mass[i];
  bodies.angular_velocity[i] =
      Vec3(bodies.angular_velocity[i]) + Vec3{turn.x / inertia.x, turn.y / inertia.y, turn.z / inertia.z};
  engine_->state.accounts.initial_kinetic += body_energy(model, engine_->state).kinetic - before;
}

double Simulation::time() const { return engine_->state.time(engine_->model); }
double Simulation::time_step() const { return engine_->model.time_step; }
std::int64_t Simulation::step() const { return engine_->state.step; }

std::vector<std::string> Simulation::pass_names() const {
  std::vector<std::string> names;
  for (const auto& pass : engine_->passes) names.push_back(pass->name());
  return names;
}

EnergyLedger Simulation::ledger() const { return make_ledger(engine_->model, engine_->state); }

std::vector<WallLoad> Simulation::take_wall_loads() {
  collect_accounts(engine_->model, engine_->state);
  Accounts& accounts = engine_->state.accounts;
  const double span = accounts.wall_load_time;
  std::vector<WallLoad> loads(accounts.wall_impulse.size());
  for (std::size_t w = 0; w < loads.size(); ++w) {
    if (span > 0) {
      loads[w].force = accounts.wall_impulse[w] / span;
      loads[w].torque = accounts.wall_angular_impulse[w] / span;
      const WallRecord& wall = engine_->state.walls.records()[w];
      // A mean force and a velocity that changes make no power: what swings takes its work over the span.
      loads[w].power = engine_->model.features.has_ledger && is_oscillating(engine_->model.scene.walls[w].motion)
                           ? (accounts.wall_work[w] - accounts.wall_work_taken[w]) / span
                           : -dot(loads[w].force, wall.velocity) - dot(loads[w].torque, wall.angular_velocity);
    }
    loads[w].work = accounts.wall_work_taken[w] = accounts.wall_work[w];
    accounts.wall_impulse[w] = accounts.wall_angular_impulse[w] = Vec3{};
  }
  accounts.wall_load_time = 0;
  return loads;
}

RunQuality Simulation::quality() const {
  const Accounts accounts = accounts_so_far(engine_->model, engine_->state);
  const double contact_time = accounts.largest_rate > 0 ? std::numbers::pi / std::sqrt(accounts.largest_rate) : 0;
  return {accounts.largest_overlap, contact_time / engine_->model.time_step, accounts.list_rebuilds};
}

BulkState Simulation::bulk() const {
  BulkState bulk;
  const auto active = to_host(engine_->state.bodies.active);
  const auto mass = to_host(engine_->model.bodies.mass);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    (active[i] ? bulk.active_bodies : bulk.removed_bodies) += 1;
    (active[i] ? bulk.active_mass : bulk.removed_mass) += mass[i];
  }
  for (const Real depth : to_host(engine_->state.contacts.depth)) bulk.contacts += depth > 0;
  return bulk;
}

Snapshot Simulation::snapshot() const {
  const State& state = engine_->state;
  Snapshot snapshot;
  snapshot.time = time();
  snapshot.step = state.step;
  snapshot.velocity = to_host(state.bodies.velocity);
  const std::size_t body_count = snapshot.velocity.size();  // the columns that follow have ghosts behind the bodies
  for (const char active : to_host(state.bodies.active)) snapshot.active.push_back(active != 0);
  snapshot.active.resize(body_count);
  snapshot.position = to_host(state.bodies.position);
  snapshot.position.resize(body_count);
  snapshot.orientation = to_host(state.bodies.orientation);
  snapshot.orientation.resize(body_count);
  snapshot.angular_velocity = to_host(state.bodies.angular_velocity);
  for (std::size_t i = 0; i < snapshot.angular_velocity.size(); ++i)
    snapshot.angular_velocity[i] = rotate(snapshot.orientation[i], snapshot.angular_velocity[i]);
  for (int w = 0; w < state.walls.count(); ++w) {
    snapshot.wall_translation.push_back(state.walls.translation(w));
    snapshot.wall_rotation.push_back(state.walls.rotation(w));
    snapshot.wall_present.push_back(state.walls.records()[w].is_present);
  }
  const auto keys = to_host(state.contacts.key);
  const auto depth = to_host(state.contacts.depth);
  const auto force = to_host(state.contacts.force);
  const auto point = to_host(state.contacts.point);
  const GhostOwners ghosts(engine_->model, state);
  const PeriodicLattice lattice = lattice_of(engine_->model.scene);
  for (std::size_t c = 0; c < keys.size(); ++c) {
    if (!(depth[c] > 0)) continue;
    const int a = key_body_a(keys[c]), b = key_body_b(keys[c]);
    snapshot.contacts.push_back({a, is_wall_kind(key_kind(keys[c])) ? -1 - b : ghosts.owner(b),
                                 point[c] - lattice.shift(lattice.step_to(snapshot.position[a])), force[c], depth[c]});
  }
  for (Vec3& position : snapshot.position) position = lattice.inside(position);
  return snapshot;
}

RunGeometry Simulation::geometry() const {
  const Model& model = engine_->model;
  RunGeometry geometry;
  for (const Shape& shape : model.scene.shapes) {
    ShapeGeometry entry{shape.name, 0, {}, shape.volume};
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry))
      entry.sphere_radius = sphere->radius;
    else
      entry.parts = std::get<PolyhedralShape>(shape.geometry).parts;
    geometry.shapes.push_back(std::move(entry));
  }
  for (const Material& material : model.scene.materials) {
    geometry.materials.push_back(material.name);
    geometry.material_density.push_back(material.density);
  }
  geometry.body_shape = to_host(model.bodies.shape);
  geometry.body_material = to_host(model.bodies.material);
  geometry.body_scale = to_host(model.bodies.scale);
  geometry.body_mass = to_host(model.bodies.mass);
  const WallSet at_start(model.scene, static_cast<int>(model.scene.shapes.size()));
  for (std::size_t w = 0; w < model.scene.walls.size(); ++w) {
    const Wall& wall = model.scene.walls[w];
    const WallRecord& record = at_start.records()[w];
    WallGeometry entry{wall.name,     wall.contact_class, record.kind,       record.point, record.direction,
                       record.length, record.base_radius, record.top_radius, {},           {}};
    if (const auto* object = std::get_if<VolumeObject>(&wall.geometry)) entry.part = object->part;
    if (const auto* mesh = std::get_if<MeshObject>(&wall.geometry)) entry.mesh = contact_surface(*mesh);
    geometry.walls.push_back(std::move(entry));
  }
  return geometry;
}

void Simulation::write_checkpoint(const std::filesystem::path& run_folder) const {
  write_checkpoint_file(run_folder, engine_->model, engine_->state);
}

std::string Simulation::read_checkpoint(const std::filesystem::path& run_folder) {
  return read_checkpoint_file(run_folder, engine_->model, engine_->state);
}

}  // namespace dem_gpu
