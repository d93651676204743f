// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/simulation.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "catalog/input_error.h"
#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/io/checkpoint.h"
#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/periodic/ghosts.h"
#include "dem_gpu/start/model_builder.h"
#include "dem_gpu/start/start_overlap.h"
#include "dem_gpu/step_builder.h"
#include "dem_gpu/steps/step_loop.h"

namespace dem_gpu {

namespace {

/// Between the surfaces of two spheres, on the line of their centres.
Vec3 sphere_contact_point(const Vec3& a, Real radius_a, const Vec3& b, Real depth) {
  return a + (radius_a - depth / 2) * unit_or(b - a, {0, 0, 1});
}

#ifdef TALUS_BACKEND_CUDA
constexpr StepBlocks kStepBlocks = StepBlocks::captured;
#else
constexpr StepBlocks kStepBlocks = StepBlocks::none;
#endif

}  // namespace

struct Simulation::Engine {
  BodyColumns initial_bodies;
  Model model;
  State state;
  StepLoop steps;

  explicit Engine(const Scene& scene)
      : model(make_model(scene, prepare_shapes(scene), initial_bodies)),
        state(start_state(model, std::move(initial_bodies))),
        steps(build_step(scene), kStepBlocks) {
    find_forces(steps.passes(), model, state);
    refuse_deep_start(model, state);
    refuse_fast_walls(model, state);
    if (model.features.has_ledger) state.accounts.initial_elastic = book_start_energy(model, state);
  }

  void refuse_truncated_polygons() const {
    const auto truncated = to_host(state.contacts.is_truncated);
    for (std::size_t c = 0; c < truncated.size(); ++c)
      if (truncated[c]) {
        const ContactKey key = state.contacts.key[c];
        throw std::runtime_error("by step " + std::to_string(state.step) + ": the overlap of body " +
                                 std::to_string(key_body_a(key)) + " with " +
                                 std::to_string(GhostOwners(model, state).owner(key_body_b(key))) +
                                 " has a face of more corners, or of more depths, than the engine holds; use stiffer "
                                 "contacts, or a level with fewer vertices or parts");
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
  engine_->steps.advance(engine_->model, engine_->state, steps);
  engine_->state.accounts.wall_load_time += static_cast<double>(steps) * engine_->model.time_step;
  wait_for_launches();
  engine_->refuse_truncated_polygons();
}

void Simulation::set_step_blocks(StepBlocks blocks) { engine_->steps.set_blocks(blocks); }
StepCounts Simulation::step_counts() const { return engine_->steps.counts(); }

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
  for (const auto& pass : engine_->steps.passes()) names.push_back(pass->name());
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
  for (const ContactRow& row : to_host(engine_->state.contacts.row)) bulk.contacts += row.depth > 0;
  bulk.candidate_pairs = static_cast<int>(engine_->state.contacts.key.size());
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
  const auto place = to_host(state.bodies.position);  // with ghosts
  const auto radius = to_host(engine_->model.bodies.bounding_radius);
  const auto rows = to_host(state.contacts.row);
  const auto point = to_host(state.contacts.point);
  const GhostOwners ghosts(engine_->model, state);
  const PeriodicLattice lattice = lattice_of(engine_->model.scene);
  for (std::size_t c = 0; c < keys.size(); ++c) {
    if (!(rows[c].depth > 0)) continue;
    const int a = key_body_a(keys[c]), b = key_body_b(keys[c]);
    const ContactKind kind = key_kind(keys[c]);
    const Vec3 at = kind == ContactKind::sphere_sphere
                        ? sphere_contact_point(place[a], radius[a], place[b], rows[c].depth)
                        : point[c];
    snapshot.contacts.push_back({a, is_wall_kind(kind) ? -1 - b : ghosts.owner(b),
                                 at - lattice.shift(lattice.step_to(snapshot.position[a])), rows[c].force,
                                 rows[c].depth});
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
