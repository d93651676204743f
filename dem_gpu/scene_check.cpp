// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "catalog/input_error.h"
#include "catalog/triangle_mesh.h"
#include "dem_gpu/meshes/contact_surface.h"
#include "dem_gpu/periodic/periodic_check.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {
namespace {

using catalog::InputError;

/// Least contact area assumed for a body, over its equivalent diameter squared: a rounded body pressed in by 5 % of its
/// diameter meets a plane over pi * 0.05 of it.
constexpr Real kLeastContactArea = 0.16;
/// Longest time step accepted, as a share of the shortest contact: beyond it restitution is off by 1 % and more.
constexpr Real kFewestSteps = 5;
/// Below it the dashpot of polyhedra, evaluated once a step, is too stiff for the step.
constexpr Real kLeastPolyhedralRestitution = 0.01;

bool is_positive(Real value) { return value > 0 && std::isfinite(value); }
bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_unit(const Vec3& v) { return std::abs(norm(v) - 1) < 1e-6; }

void demand(bool condition, const std::string& place, const std::string& what) {
  if (!condition) throw InputError(place + ": " + what);
}

Real equivalent_diameter(const Shape& shape, Real scale) {
  return scale * std::cbrt(6 * shape.volume / std::numbers::pi);
}

Real face_area(const catalog::ConvexPart& part, const catalog::ConvexFace& face) {
  const auto at = [&](std::size_t c) {
    const catalog::Point& p = part.vertices[face.vertices[c]];
    return Vec3{p[0], p[1], p[2]};
  };
  Vec3 area;
  for (std::size_t c = 2; c < face.vertices.size(); ++c) area += Real(0.5) * cross(at(c - 1) - at(0), at(c) - at(0));
  return norm(area);
}

/// Largest flat outer face of a shape at scale 1; faces of several parts in one plane count as one, so that it does not
/// depend on the cut [m2].
Real largest_flat_area(const PolyhedralShape& polyhedron) {
  struct Flat {
    Vec3 normal;
    Real offset, area;
  };
  std::vector<Flat> flats;
  for (const catalog::ConvexPart& part : polyhedron.parts)
    for (const catalog::ConvexFace& face : part.faces) {
      if (face.kind != catalog::FaceKind::outer) continue;
      const Vec3 normal{face.plane.normal[0], face.plane.normal[1], face.plane.normal[2]};
      const Real area = face_area(part, face), offset = face.plane.offset;
      const auto same = std::find_if(flats.begin(), flats.end(), [&](const Flat& flat) {
        return dot(flat.normal, normal) > 1 - Real(1e-12) &&
               std::abs(flat.offset - offset) <= Real(1e-6) * (std::abs(offset) + std::sqrt(area));
      });
      if (same == flats.end())
        flats.push_back({normal, offset, area});
      else
        same->area += area;
    }
  Real largest = 0;
  for (const Flat& flat : flats) largest = std::max(largest, flat.area);
  return largest;
}

/// Largest flat contact of a shape at scale 1: its largest flat face, or the least area assumed [m2].
Real largest_contact_area(const Shape& shape) {
  const Real diameter = equivalent_diameter(shape, 1), least = kLeastContactArea * diameter * diameter;
  const auto* polyhedron = std::get_if<PolyhedralShape>(&shape.geometry);
  return polyhedron ? std::max(least, largest_flat_area(*polyhedron)) : least;
}

/// Least share of a body's mass that a push at one of its corners meets, the body giving way by turning:
/// 1 / (1 + m (r x n) I^-1 (r x n)), over the corners r and the directions n between the faces that meet there.
Real least_corner_share(const Shape& shape) {
  const auto* polyhedron = std::get_if<PolyhedralShape>(&shape.geometry);
  if (!polyhedron) return 1;
  const Vec3& inertia = shape.principal_inertia;
  Real largest = 0;
  const auto try_push = [&](const Vec3& corner, const Vec3& direction) {
    const Vec3 arm = cross(corner, direction);
    const Vec3 turned{arm.x / inertia.x, arm.y / inertia.y, arm.z / inertia.z};
    largest = std::max(largest, shape.volume * dot(arm, turned));
  };
  const auto to_vec3 = [](const catalog::Point& p) { return Vec3{p[0], p[1], p[2]}; };
  for (const catalog::ConvexPart& part : polyhedron->parts) {
    std::vector<std::vector<Vec3>> normals(part.vertices.size());  // of the outer faces at each corner
    for (const catalog::ConvexFace& face : part.faces)
      if (face.kind == catalog::FaceKind::outer)
        for (const int vertex : face.vertices) normals[vertex].push_back(to_vec3(face.plane.normal));
    for (std::size_t v = 0; v < normals.size(); ++v)
      for (const Vec3& one : normals[v])
        for (const Vec3& other : normals[v]) try_push(to_vec3(part.vertices[v]), unit_or(one + other, one));
  }
  return 1 / (1 + largest);
}

Real mass_of(const Scene& scene, const Body& body) {
  const Real scale = body.scale;
  return scene.materials[body.material].density * scene.shapes[body.shape].volume * scale * scale * scale;
}

/// Stiffness of two flat faces per area, over the law's stiffness: the depth potential has the fields of both.
Real stiffness_per_area_ratio(const PolyhedralLaw& law) { return depth_potential(law) ? 2 : 1; }

Real stiffness_per_area(const PolyhedralLaw& law) {
  return std::visit([](const auto& chosen) { return chosen.stiffness_per_area(); }, law);
}

/// Tangent stiffness of a flat contact as deep as the law reckons with, over that at touch.
Real stiffening(const PolyhedralLaw& law) {
  const auto* hardening = std::get_if<HardeningDepthPotential>(&law);
  return hardening ? 1 + 2 * hardening->flat_overlap / hardening->hardening : Real(1);
}

/// Tangent stiffness of a sphere contact pressed in by 2 % of the radius [N/m].
Real sphere_stiffness(const Scene& scene, const Body& body) {
  if (const auto* linear = std::get_if<LinearSpring>(&scene.sphere_law)) return linear->stiffness;
  const Material& material = scene.materials[body.material];
  const Real radius = body.scale * std::get<SphereShape>(scene.shapes[body.shape].geometry).radius;
  const Real modulus = material.youngs_modulus / (1 - material.poisson_ratio * material.poisson_ratio);
  return Hertz{}.tangent_stiffness(Real(0.02) * radius, radius, modulus);
}

/// `area`: largest contact area of the body's shape at scale 1 [m2].
Real contact_stiffness(const Scene& scene, const Body& body, Real area) {
  const Shape& shape = scene.shapes[body.shape];
  if (std::holds_alternative<SphereShape>(shape.geometry)) return sphere_stiffness(scene, body);
  return stiffening(scene.polyhedral_law) * stiffness_per_area(scene.polyhedral_law) * area * body.scale * body.scale;
}

/// Stiffest sphere of the scene [N/m]; 0 without spheres.
Real largest_sphere_stiffness(const Scene& scene) {
  Real stiffness = 0;
  for (const Body& body : scene.bodies)
    if (std::holds_alternative<SphereShape>(scene.shapes[body.shape].geometry))
      stiffness = std::max(stiffness, sphere_stiffness(scene, body));
  return stiffness;
}

const Body* heaviest_polyhedron(const Scene& scene) {
  const Body* heaviest = nullptr;
  for (const Body& body : scene.bodies)
    if (std::holds_alternative<PolyhedralShape>(scene.shapes[body.shape].geometry) &&
        (!heaviest || mass_of(scene, body) > mass_of(scene, *heaviest)))
      heaviest = &body;
  return heaviest;
}

/// overlap / hardening depth, 0 for a law without hardening.
Real hardened_share(const PolyhedralLaw& law, Real overlap) {
  const auto* hardening = std::get_if<HardeningDepthPotential>(&law);
  return hardening ? overlap / hardening->hardening : 0;
}

/// Energy over stiffness of a body pressed into a flat wall: share * integral of psi(depth) over the overlap,
/// psi = depth (1 + depth / l). `overlap`: share of the diameter. With its largest flat face, a prism [m5]:
Real face_energy(const Scene& scene, const Body& body, Real overlap) {
  const Shape& shape = scene.shapes[body.shape];
  const Real depth = overlap * equivalent_diameter(shape, body.scale);
  return stiffness_per_area_ratio(scene.polyhedral_law) * largest_contact_area(shape) * body.scale * body.scale *
         depth * depth * (Real(0.5) + hardened_share(scene.polyhedral_law, overlap) / 3);
}

/// With a corner of a cube: a pyramid of section 3 sqrt(3) / 2 t^2 at distance t from its tip, where the depth is d -
/// t.
Real corner_energy(const Scene& scene, const Body& body, Real overlap) {
  const Real depth = overlap * equivalent_diameter(scene.shapes[body.shape], body.scale);
  return stiffness_per_area_ratio(scene.polyhedral_law) * Real(1.5) * std::sqrt(Real(3)) * depth * depth * depth *
         depth * (Real(1) / 12 + hardened_share(scene.polyhedral_law, overlap) / 30);
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
    demand(scene.friction->tangential_stiffness_ratio >= 0 && std::isfinite(scene.friction->tangential_stiffness_ratio),
           "friction", "tangential stiffness ratio must not be negative");
  if (has_shape(scene, false))
    demand(is_positive(stiffness_per_area(scene.polyhedral_law)), "contact law of polyhedra",
           "stiffness must be positive");
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

Real shortest_contact_time(const Scene& scene) {
  const Real against_sphere = largest_sphere_stiffness(scene);
  std::vector<Real> area, corner_share;
  for (const Shape& shape : scene.shapes) {
    area.push_back(largest_contact_area(shape));
    corner_share.push_back(against_sphere > 0 ? least_corner_share(shape) : 1);
  }
  Real shortest = std::numeric_limits<Real>::max();
  for (const Body& body : scene.bodies) {
    const Real effective_mass = mass_of(scene, body) / 2;  // against its like
    const Real stiffness = contact_stiffness(scene, body, area[body.shape]);
    if (std::holds_alternative<PolyhedralShape>(scene.shapes[body.shape].geometry) && against_sphere > 0)
      shortest = std::min(
          shortest, std::numbers::pi * std::sqrt(corner_share[body.shape] * mass_of(scene, body) / against_sphere));
    shortest = std::min(shortest, std::numbers::pi * std::sqrt(effective_mass / stiffness));
  }
  return shortest;
}

Real time_step(const Scene& scene) {
  return scene.run.time_step > 0 ? scene.run.time_step : shortest_contact_time(scene) / scene.run.steps_per_contact;
}

const DepthPotential* depth_potential(const PolyhedralLaw& law) {
  if (const auto* hardening = std::get_if<HardeningDepthPotential>(&law)) return hardening;
  return std::get_if<DepthPotential>(&law);
}

Real stiffness_for_overlap(const Scene& scene, Real speed, Real largest_overlap, OverlapAt at) {
  const Body* heaviest = heaviest_polyhedron(scene);
  if (!heaviest) return 0;
  const Real energy = at == OverlapAt::face ? face_energy(scene, *heaviest, largest_overlap)
                                            : corner_energy(scene, *heaviest, largest_overlap);
  return Real(0.5) * mass_of(scene, *heaviest) * speed * speed / energy;
}

Real flat_overlap(const Scene& scene, Real speed) {
  const Body* heaviest = heaviest_polyhedron(scene);
  if (!heaviest) return 0;
  const Real stiffness = std::visit([](const auto& law) { return law.stiffness; }, scene.polyhedral_law);
  const Real energy = Real(0.5) * mass_of(scene, *heaviest) * speed * speed / stiffness;
  Real low = 0, high = 1;
  while (face_energy(scene, *heaviest, high) < energy) high *= 2;
  for (int bisection = 0; bisection < 60; ++bisection) {
    const Real middle = (low + high) / 2;
    (face_energy(scene, *heaviest, middle) < energy ? low : high) = middle;
  }
  return high;
}

}  // namespace dem_gpu
