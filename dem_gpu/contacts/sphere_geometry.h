// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/contact_kernel.h"
#include "dem_gpu/contacts/friction/rolling_friction.h"
#include "dem_gpu/contacts/laws/adhesive.h"
#include "dem_gpu/narrow_phase/closest_point.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {

/// Distance from a sphere's centre to the other surface, and the unit direction from the centre into the other solid.
struct SphereGap {
  Real distance = 0;          // [m]; contact if below the radius
  Vec3 direction;             // contact normal
  Real effective_radius = 0;  // [m]
};

TALUS_HD inline void fill_patch(const SphereGap&, NoPatch&) {}
TALUS_HD inline void fill_patch(const SphereGap& gap, SpherePatch& patch) {
  patch.effective_radius = gap.effective_radius;
}

/// Elastic contact of a sphere under a sphere law; false without overlap.
template <class Law, class Patch>
TALUS_HD bool sphere_contact(const Law& law, const Vec3& centre, Real radius, const SphereGap& gap,
                             const PairProperties& pair, ElasticContact& elastic, Patch& patch) {
  const Real overlap = radius - gap.distance;
  if (!(overlap > 0)) return false;
  elastic.normal = gap.direction;
  elastic.depth = overlap;
  elastic.stiffness = law.tangent_stiffness(overlap, gap.effective_radius, pair.effective_modulus);
  Real force = law.normal_force(overlap, gap.effective_radius, pair.effective_modulus);
  elastic.energy = force * overlap / (Law::kExponent + 1);
  if constexpr (Law::kIsAdhesive) {
    elastic.adhesion = Law::attraction(pair.adhesion, gap.effective_radius);
    force -= elastic.adhesion;
    elastic.energy -= elastic.adhesion * overlap;
  }
  elastic.force = -force * gap.direction;
  elastic.point = centre + (gap.distance + overlap / 2) * gap.direction;
  elastic.torque_a = Vec3{};
  fill_patch(gap, patch);
  return true;
}

/// Least signed distance of a point from the parts of a polyhedral body; the normal points from the body to the point.
TALUS_HD inline PartDistance distance_to_body(const ShapeView& shapes, int shape, const Pose& pose, const Vec3& x,
                                              Real reach) {
  const Vec3 local = (1 / pose.scale) * transpose_times(pose.rotation, x - pose.position);
  const Real local_reach = reach / pose.scale;
  PartDistance nearest{2 * local_reach + 1, {0, 0, 1}};
  const ShapeRange& range = shapes.shapes[shape];
  for (int p = 0; p < range.part_count; ++p) {
    const PartView part = part_view(shapes, range.first_part + p);
    const Real part_reach = local_reach + part.range.radius;
    if (norm_squared(local - part.range.centre) >= part_reach * part_reach) continue;
    const PartDistance distance = distance_to_part(part, local, local_reach);
    if (distance.distance < nearest.distance) nearest = distance;
  }
  return {pose.scale * nearest.distance, pose.rotation * nearest.outward};
}

template <class Law>
std::variant<NoFriction, SphereFriction<Law>, RollingFriction<Law>> sphere_friction(const Scene& scene) {
  if (!scene.friction) return NoFriction{};
  if (has_rolling_friction(scene)) return RollingFriction<Law>{};
  return SphereFriction<Law>{};
}

inline std::variant<LinearSpring, Hertz, Adhesive<LinearSpring>, Adhesive<Hertz>> sphere_law(const Scene& scene) {
  const auto* linear = std::get_if<LinearSpring>(&scene.sphere_law);
  if (!has_adhesion(scene)) {
    if (linear) return *linear;
    return Hertz{};
  }
  if (linear) return Adhesive<LinearSpring>{*linear};
  return Adhesive<Hertz>{};
}

/// The choice of kernel for a kind of sphere contact, made once. `make_geometry(law)` gives its geometry.
template <class MakeGeometry>
std::unique_ptr<Pass> make_sphere_pass(const std::string& name, ContactKind kind, const Scene& scene,
                                       const MakeGeometry& make_geometry) {
  const auto make = [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    return make_contact_pass(name, kind, scene, std::variant<Law>(law), sphere_friction<Law>(scene), make_geometry);
  };
  return std::visit(make, sphere_law(scene));
}

}  // namespace dem_gpu
