// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/periodic/periodic_check.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {
namespace {

using catalog::InputError;

/// Longest time step accepted, as a share of the shortest contact: beyond it restitution is off by 1 % and more.
constexpr Real kFewestSteps = 5;
/// Below it the dashpot of polyhedra, evaluated once a step, is too stiff for the step.
constexpr Real kLeastPolyhedralRestitution = 0.01;

/// A couple of the normal force on a longer lever than the radius is none of rolling; the spring that holds it goes
/// with the square and leaves the step behind.
constexpr Real kMostRollingFriction = 1;

bool is_positive(Real value) { return value > 0 && std::isfinite(value); }
bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_unit(const Vec3& v) { return std::abs(norm(v) - 1) < 1e-6; }

void demand(bool condition, const std::string& place, const std::string& what) {
  if (!condition) throw InputError(place + ": " + what);
}

struct CheckWall {
  std::string place;

  void operator()(const Plane& plane) const {
    demand(is_unit(plane.normal) && is_finite(plane.point), place, "normal must be a unit vector");
  }
  void operator()(const Disc& disc) const {
    demand(is_finite(disc.centre), place, "centre must be finite");
    demand(is_unit(disc.normal), place, "normal must be a unit vector");
    demand(is_positive(disc.radius), place, "radius must be positive");
    demand(!disc.thickness || is_positive(*disc.thickness), place, "thickness must be positive");
  }
  void operator()(const Cylinder& cylinder) const {
    demand(is_finite(cylinder.base), place, "base must be finite");
    demand(is_unit(cylinder.axis), place, "axis must be a unit vector");
    demand(is_positive(cylinder.radius) && is_positive(cylinder.length), place, "radius and length must be positive");
  }
  void operator()(const Cone& cone) const {
    demand(is_finite(cone.base), place, "base must be finite");
    demand(is_unit(cone.axis), place, "axis must be a unit vector");
    demand(cone.base_radius >= 0 && cone.top_radius >= 0 && is_positive(cone.length), place,
           "radii must not be negative and length must be positive");
    demand(cone.base_radius > 0 || cone.top_radius > 0, place, "one of the radii must be positive");
  }
  void operator()(const Ball& ball) const {
    demand(is_finite(ball.centre), place, "centre must be finite");
    demand(is_positive(ball.radius), place, "radius must be positive");
  }
  void operator()(const VolumeObject& object) const {
    try {
      polyhedral_shape("block", {object.part});
    } catch (const InputError& error) {
      throw InputError(place + ": not a convex solid (" + error.what() + ")");
    }
  }
  void operator()(const MeshObject& object) const {
    demand(object.depth >= 0 && std::isfinite(object.depth), place, "depth must not be negative");
    try {
      contact_surface(object);
    } catch (const InputError& error) {
      throw InputError(place + ": " + error.what());
    }
  }
};

bool has_shape(const Scene& scene, bool sphere) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
    return std::holds_alternative<SphereShape>(scene.shapes[body.shape].geometry) == sphere;
  });
}

void check_not_negative(Real value, const std::string& place, const std::string& name) {
  demand(value >= 0 && std::isfinite(value), place, name + " must not be negative");
}

void check_materials(const Scene& scene) {
  demand(!scene.materials.empty(), "materials", "at least one is needed");
  for (const Material& material : scene.materials) {
    const std::string place = "material '" + material.name + "'";
    demand(is_positive(material.density) && is_positive(material.youngs_modulus), place,
           "density and Young's modulus must be positive");
    demand(material.poisson_ratio > -1 && material.poisson_ratio <= Real(0.5), place,
           "Poisson's ratio must lie in -1 .. 0.5");
  }
}

void check_contacts(const Scene& scene) {
  const bool has_polyhedra = has_shape(scene, false);
  demand(scene.contact.size() == scene.materials.size(), "contact", "one row a material is needed");
  for (std::size_t i = 0; i < scene.contact.size(); ++i) {
    demand(scene.contact[i].size() == scene.materials.size(), "contact", "one column a material is needed");
    for (std::size_t j = 0; j < scene.contact.size(); ++j) {
      const std::string place = "contact of '" + scene.materials[i].name + "' with '" + scene.materials[j].name + "'";
      const ContactProperties& properties = scene.contact[i][j];
      demand(properties.restitution >= 0 && properties.restitution <= 1, place, "restitution must lie in 0 .. 1");
      demand(properties.restitution >= kLeastPolyhedralRestitution || !has_polyhedra, place,
             "restitution of polyhedra must be at least 0.01");
      check_not_negative(properties.friction_coefficient, place, "friction");
      check_not_negative(properties.rolling_friction, place, "rolling friction");
      demand(properties.rolling_friction <= kMostRollingFriction, place, "rolling friction must be at most 1");
      check_not_negative(properties.adhesion, place, "adhesion");
      demand(properties.rolling_friction == 0 || scene.friction, place,
             "rolling friction needs friction, which this scene has turned off");
    }
  }
  for (std::size_t i = 0; i < scene.contact.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      demand(scene.contact[i][j].restitution == scene.contact[j][i].restitution &&
                 scene.contact[i][j].friction_coefficient == scene.contact[j][i].friction_coefficient &&
                 scene.contact[i][j].rolling_friction == scene.contact[j][i].rolling_friction &&
                 scene.contact[i][j].adhesion == scene.contact[j][i].adhesion,
             "contact of '" + scene.materials[j].name + "' with '" + scene.materials[i].name + "'",
             "restitution, friction and adhesion must be the same both ways");
}

void check_bodies(const Scene& scene) {
  demand(!scene.bodies.empty(), "scene '" + scene.name + "'", "no bodies; a [[fill]] is needed");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const std::string place = "body " + std::to_string(i);
    demand(body.shape >= 0 && body.shape < static_cast<int>(scene.shapes.size()), place, "no such shape");
    demand(body.material >= 0 && body.material < static_cast<int>(scene.materials.size()), place, "no such material");
    demand(is_positive(body.scale), place, "size must be positive");
    demand(is_finite(body.position) && is_finite(body.velocity) && is_finite(body.angular_velocity), place,
           "position and velocity must be finite");
    demand(!body.is_fixed || (norm(body.velocity) == 0 && norm(body.angular_velocity) == 0), place,
           "a fixed body must be at rest; set its velocities to zero, or make it a wall with a motion");
    const Quaternion& q = body.orientation;
    demand(is_positive(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z), place,
           "orientation must be a finite quaternion other than zero");
  }
}

void check_walls(const Scene& scene) {
  std::set<std::string> names;
  for (const Wall& wall : scene.walls) {
    const std::string place = "wall '" + wall.name + "'";
    demand(names.insert(wall.name).second, place, "there are two of that name");
    demand(wall.material >= 0 && wall.material < static_cast<int>(scene.materials.size()), place, "no such material");
    std::visit(CheckWall{place}, wall.geometry);
    const Motion& motion = wall.motion;
    demand(is_finite(motion.rotation_centre) && is_finite(motion.angular_velocity) && is_finite(motion.velocity) &&
               is_finite(motion.amplitude) && is_finite(motion.angular_amplitude) && std::isfinite(motion.phase) &&
               std::isfinite(motion.start_time) && motion.ramp_time >= 0 && std::isfinite(motion.ramp_time),
           place, "motion must be finite and its ramp time not negative");
    demand(motion.frequency >= 0 && std::isfinite(motion.frequency), place, "frequency must not be negative");
    for (const Wall& other : scene.walls)
      demand(wall.group.empty() || wall.group != other.group || wall.motion == other.motion, place,
             "moves otherwise than wall '" + other.name + "' of its group '" + wall.group + "'");
    demand(!wall.removed_at || !std::isnan(*wall.removed_at), place, "the time of removal must be a number");
  }
}

void check_run(const Scene& scene) {
  demand(is_finite(scene.gravity), "gravity", "must be finite");
  if (scene.outflow)
    demand(is_unit(scene.outflow->direction) && !std::isnan(scene.outflow->height), "outflow",
           "direction must be a unit vector and height a number");
  if (scene.friction)
    demand(is_positive(scene.friction->tangential_stiffness_ratio), "friction",
           "tangential stiffness ratio must be positive; leave friction out for a scene without");
  if (has_shape(scene, false))
    demand(is_positive(std::visit([](const auto& law) { return law.stiffness; }, scene.polyhedral_law)),
           "contact law of polyhedra", "stiffness must be positive");
  if (const DepthPotential* depth = depth_potential(scene.polyhedral_law); depth && has_shape(scene, false))
    demand(is_positive(depth->depth_cap), "contact law of polyhedra", "depth cap must be positive");
  if (const auto* law = std::get_if<HardeningDepthPotential>(&scene.polyhedral_law); law && has_shape(scene, false)) {
    demand(is_positive(law->hardening), "contact law of polyhedra",
           "hardening must be positive; leave it out for a law without hardening");
    demand(law->flat_overlap >= 0 && std::isfinite(law->flat_overlap), "contact law of polyhedra",
           "the flat overlap must not be negative");
  }
  if (const auto* linear = std::get_if<LinearSpring>(&scene.sphere_law); linear && has_shape(scene, true))
    demand(is_positive(linear->stiffness), "contact law of spheres", "stiffness must be positive");
  demand(scene.run.largest_start_overlap > 0, "run", "largest overlap at the start must be positive");
  demand(scene.run.end_time >= 0 && scene.run.time_step >= 0, "run", "times must not be negative");
  demand(scene.run.time_step > 0 || scene.run.steps_per_contact >= kFewestSteps, "run",
         "steps per contact must be at least 5 where no time step is given");
  const Real shortest = shortest_contact_time(scene);
  if (scene.run.time_step > shortest / kFewestSteps)
    throw InputError(
        "run: time step " + std::to_string(scene.run.time_step * 1e6) + " us is too long: the shortest contact takes " +
        std::to_string(shortest * 1e6) + " us and needs at least " + std::to_string(static_cast<int>(kFewestSteps)) +
        " steps; use at most " + std::to_string(shortest / 20 * 1e6) + " us (20 steps), or a softer contact law");
}

template <class Property>
bool has_positive(const Scene& scene, const Property& property) {
  for (const std::vector<ContactProperties>& row : scene.contact)
    for (const ContactProperties& properties : row)
      if (property(properties) > 0) return true;
  return false;
}

}  // namespace

bool has_rolling_friction(const Scene& scene) {
  return has_positive(scene, [](const ContactProperties& properties) { return properties.rolling_friction; });
}

bool has_adhesion(const Scene& scene) {
  return has_positive(scene, [](const ContactProperties& properties) { return properties.adhesion; });
}

void check(const Scene& scene) {
  check_materials(scene);
  check_bodies(scene);
  check_contacts(scene);
  check_walls(scene);
  check_run(scene);
  check_periodic(scene);
}

const DepthPotential* depth_potential(const PolyhedralLaw& law) {
  if (const auto* hardening = std::get_if<HardeningDepthPotential>(&law)) return hardening;
  return std::get_if<DepthPotential>(&law);
}

}  // namespace dem_gpu
