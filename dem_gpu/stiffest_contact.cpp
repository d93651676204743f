// SPDX-License-Identifier: Apache-2.0
// What the stiffest contact of a scene is like, before anything moves: how long it takes, how deep it gets.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "dem_gpu/scene.h"

namespace dem_gpu {
namespace {

/// Least contact area assumed for a body, over its equivalent diameter squared: a rounded body pressed in by 5 % of its
/// diameter meets a plane over pi * 0.05 of it.
constexpr Real kLeastContactArea = 0.16;

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

}  // namespace

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
