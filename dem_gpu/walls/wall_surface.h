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
  if (wall.kind == WallKind::sphere) {
    const Real outside = norm(x - wall.point) - wall.base_radius;
    return {wall.solid_within ? -outside : outside, 1, 1};
  }
  const AxialPosition position = axial_position(wall, x);
  if (wall.kind == WallKind::disc) {
    const Real from_back = wall.thickness > 0 ? wall.thickness + position.along : Real(1);
    return {-position.along, wall.base_radius - position.radius, from_back};
  }
  const Real slope = (wall.top_radius - wall.base_radius) / wall.length;
  const Real gap = position.radius - (wall.base_radius + slope * position.along);
  const Real depth = (wall.solid_within ? -gap : gap) / std::sqrt(1 + slope * slope);
  return {depth, position.along, wall.length - position.along};
}

/// Signed distance of a point from a wall's surface, positive in the solid, and the unit direction into the solid
/// there.
struct SurfaceDistance {
  Real depth = 0;  // [m]
  Vec3 into_wall;
  int rim = -1;  // 0, 1: the nearest point lies on the rim at the base, at the top
};

/// Round plate: a rectangle in the half-plane of radius and axis.
TALUS_HD inline SurfaceDistance plate_distance(const WallRecord& wall, const AxialPosition& position) {
  const Real above = position.along, below = -wall.thickness - position.along;
  const Real beside = position.radius - wall.base_radius;
  const Real over = above > 0 ? above : below > 0 ? -below : Real(0);  // signed, along the normal
  if (over != 0 || beside > 0) {
    const Vec3 outward = over * wall.direction + (beside > 0 ? beside : Real(0)) * position.outward;
    const Real distance = norm(outward);
    return {-distance, (-1 / distance) * outward};
  }
  if (beside >= above && beside >= below) return {-beside, -position.outward};
  return above >= below ? SurfaceDistance{-above, -wall.direction} : SurfaceDistance{-below, wall.direction};
}

TALUS_HD inline SurfaceDistance surface_distance(const WallRecord& wall, const Vec3& x) {
  if (wall.kind == WallKind::plane) return {dot(wall.direction, wall.point - x), -wall.direction};
  if (wall.kind == WallKind::sphere) {
    const Vec3 offset = x - wall.point;
    const Real distance = norm(offset), outside = distance - wall.base_radius;
    const Vec3 outward = distance > 0 ? offset / distance : any_perpendicular(wall.direction);
    return wall.solid_within ? SurfaceDistance{-outside, -outward} : SurfaceDistance{outside, outward};
  }
  const AxialPosition position = axial_position(wall, x);
  if (wall.kind == WallKind::disc && wall.thickness > 0) return plate_distance(wall, position);
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
    // Into the solid: away from the axis about a cylinder or cone, against the normal of a disc.
    const Real length = std::sqrt(square);
    const Vec3 outward = (step_along / length) * position.outward - (step_radius / length) * wall.direction;
    const Vec3 into = is_disc ? -wall.direction : wall.solid_within ? -outward : outward;
    return {-dot(to_surface, into), into};
  }
  const Real distance = norm(to_surface);
  return {-distance, distance > 0 ? to_surface / distance : position.outward, share <= 0 ? 0 : 1};
}

}  // namespace dem_gpu
