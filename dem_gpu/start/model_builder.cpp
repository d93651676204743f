// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/start/model_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dem_gpu/broad_phase/skin.h"
#include "dem_gpu/contacts/contact_passes.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/energy/energy.h"
#include "dem_gpu/periodic/ghosts.h"
#include "dem_gpu/shapes/least_width.h"
#include "dem_gpu/walls/hidden_faces.h"

namespace dem_gpu {
namespace {

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
  const Real of_tangent = std::sqrt(damped_stiffness(Real(1), 1 / sphere_exponent));
  std::map<Real, Real> solved;
  std::vector<PairProperties> pairs(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const ContactProperties& contact = scene.contact[i][j];
      const Real restitution = contact.restitution;
      if (!solved.contains(restitution)) solved[restitution] = damping_ratio(restitution);
      const Material &a = scene.materials[i], &b = scene.materials[j];
      const Real stiffness_ratio = tangential_stiffness_ratio(scene, a, b);
      pairs[i * n + j] = {solved[restitution],     contact.friction_coefficient,
                          effective_modulus(a, b), of_tangent * solved[restitution],
                          stiffness_ratio,         contact.rolling_friction,
                          contact.adhesion,        of_tangent * solved[restitution] * std::sqrt(stiffness_ratio)};
    }
  return pairs;
}

void set_bodies(const Scene& scene, const PreparedShapes& prepared, BodyConstants& constants, BodyColumns& columns) {
  const std::size_t n = scene.bodies.size();
  const std::vector<ShapeRange> shapes = to_host(prepared.columns.shapes);
  std::vector<int> shape(n), material(n);
  std::vector<Real> scale(n), mass(n), inverse_mass(n), radius(n), diameter(n), width(n);
  std::vector<Vec3> inertia(n), inverse_inertia(n), position(n), velocity(n), angular_velocity(n);
  std::vector<Quaternion> orientation(n);
  std::vector<char> active(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Body& body = scene.bodies[i];
    const ShapeRange& range = shapes[body.shape];
    const Real s = body.scale, density = scene.materials[body.material].density;
    shape[i] = body.shape;
    material[i] = body.material;
    scale[i] = s;
    mass[i] = density * range.volume * s * s * s;
    inverse_mass[i] = body.is_fixed ? 0 : 1 / mass[i];
    inertia[i] = (density * s * s * s * s * s) * range.inertia;
    if (!body.is_fixed) inverse_inertia[i] = {1 / inertia[i].x, 1 / inertia[i].y, 1 / inertia[i].z};
    radius[i] = s * range.bounding_radius;
    diameter[i] = s * range.equivalent_diameter;
    width[i] = s * prepared.least_width[body.shape];
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
  assign(constants.inverse_mass, inverse_mass);
  assign(constants.inertia, inertia);
  assign(constants.inverse_inertia, inverse_inertia);
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
  columns.contact_share.assign(n, Real(1));
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

}  // namespace

PreparedShapes prepare_shapes(const Scene& scene) {
  PreparedShapes prepared{
      make_shape_columns(shapes_with_objects(scene), depth_cap(scene)), {}, static_cast<int>(scene.shapes.size())};
  for (const Shape& shape : scene.shapes) prepared.least_width.push_back(least_width(shape));
  return prepared;
}

Model make_model(const Scene& scene, PreparedShapes shapes, BodyColumns& at_start) {
  Model model;
  model.scene = scene;
  set_bodies(scene, shapes, model.bodies, at_start);
  model.shapes = std::move(shapes);
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
  model.features.has_waiting_pairs = model.features.has_polyhedra && !scene.periodic;
  if (model.features.has_waiting_pairs) at_start.travel.assign(scene.bodies.size(), Real(0));
  model.features.has_friction_couples =
      has_rolling_friction(scene) || (model.features.has_friction && model.features.has_polyhedra);
  model.time_step = time_step(scene);
  Real mean_diameter = 0;
  for (const Real diameter : to_host(model.bodies.diameter)) mean_diameter += diameter;
  model.mean_diameter = mean_diameter / static_cast<Real>(scene.bodies.size());
  set_classes(scene, model);
  return model;
}

State start_state(const Model& model, BodyColumns at_start) {
  const Scene& scene = model.scene;
  State state{0,
              std::move(at_start),
              {},
              {},
              {},
              {},
              WallSet(scene, model.shapes.first_object),
              kFirstSkin * model.mean_diameter,
              0,
              true,
              {},
              {}};
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
  return state;
}

void find_forces(const std::vector<std::unique_ptr<Pass>>& passes, Model& model, State& state) {
  const Real time_step = std::exchange(model.time_step, Real(0));
  for (const auto& pass : passes)
    if (pass->finds_forces()) pass->run(model, state);
  model.time_step = time_step;
}

}  // namespace dem_gpu
