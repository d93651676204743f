// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "dem_gpu/walls/wall_columns.h"

namespace dem_gpu {

/// Where a point stands against an analytic wall. The wall's solid is where all three are >= 0.
struct WallField {
  Real depth = 0;      // below the surface [m]; 1-Lipschitz
  Real from_base = 1;  // inside the wall's extent [m]
  Real from_top = 1;
};

/// Cylindrical coordinates about the wall's axis.
struct AxialPosition {
  Real along = 0;   // [m] from the base
  Real radius = 0;  // [m]
  Vec3 outward;     // unit, radial
};

TALUS_HD inline AxialPosition axial_position(const WallRecord& wall, const Vec3& x) {
  AxialPosition position;
  const Vec3 offset = x - wall.point;
  position.along = dot(offset, wall.direction);
  const Vec3 radial = offset - position.along * wall.direction;
  position.radius = norm(radial);
  position.outward = position.radius > 0 ? radial / position.radius : any_perpendicular(wall.direction);
  return position;
}

TALUS_HD inline WallField wall_field(const WallRecord& wall, const Vec3& x) {
  if (wall.kind == WallKind::plane) return {dot(wall.direction, wall.point - x), 1, 1};
  const AxialPosition position = axial_position(wall, x);
  if (wall.kind == WallKind::disc) return {-position.along, wall.base_radius - position.radius, 1};
  const Real slope = (wall.top_radius - wall.base_radius) / wall.length;
  const Real gap = position.radius - (wall.base_radius + slope * position.along);
  return {gap / std::sqrt(1 + slope * slope), position.along, wall.length - position.along};
}

/// Normal of a wall's surface nearest to x, from the wall to the bodies.
TALUS_HD inline Vec3 wall_normal(const WallRecord& wall, const Vec3& x) {
  if (wall.kind == WallKind::plane || wall.kind == WallKind::disc) return wall.direction;
  const Real slope = (wall.top_radius - wall.base_radius) / wall.length;
  return (-1 / std::sqrt(1 + slope * slope)) * (axial_position(wall, x).outward - slope * wall.direction);
}

/// Signed distance of a point from a wall's surface, positive in the solid, and the unit direction into the solid
/// there.
struct SurfaceDistance {
  Real depth = 0;  // [m]
  Vec3 into_wall;
};

TALUS_HD inline SurfaceDistance surface_distance(const WallRecord& wall, const Vec3& x) {
  if (wall.kind == WallKind::plane) return {dot(wall.direction, wall.point - x), -wall.direction};
  const AxialPosition position = axial_position(wall, x);
  // The surface's generator is a segment in the (radius, along) half-plane.
  const bool is_disc = wall.kind == WallKind::disc;
  const Real start_radius = is_disc ? 0 : wall.base_radius;
  const Real step_radius = is_disc ? wall.base_radius : wall.top_radius - wall.base_radius;
  const Real step_along = is_disc ? 0 : wall.length;
  const Real square = step_radius * step_radius + step_along * step_along;
  const Real share = ((position.radius - start_radius) * step_radius + position.along * step_along) / square;
  const Real inside = share < 0 ? 0 : share > 1 ? 1 : share;
  const Real gap_radius = start_radius + inside * step_radius - position.radius;
  const Real gap_along = inside * step_along - position.along;
  const Vec3 to_surface = gap_radius * position.outward + gap_along * wall.direction;
  if (share > 0 && share < 1) {
    // Into the solid: away from the axis for cylinder and cone, against the normal for a disc.
    const Real length = std::sqrt(square);
    const Vec3 into =
        is_disc ? -wall.direction : (step_along / length) * position.outward - (step_radius / length) * wall.direction;
    return {-dot(to_surface, into), into};
  }
  const Real distance = norm(to_surface);
  return {-distance, distance > 0 ? to_surface / distance : position.outward};
}

}  // namespace dem_gpu
