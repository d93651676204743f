// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/narrow_phase/polygon.h"
#include "dem_gpu/walls/wall_surface.h"

namespace dem_gpu {

/// The part of a plane that a ball, shaft or cone reaches: a rectangle in the plane, so that a face much larger than
/// the wall is cut into pieces where the wall is.
struct CurvedWindow {
  LocalHalfSpace side[6];
  int count = 0;
  bool is_empty = false;
  Real half_width = 0;  // across the wall [m]

  TALUS_HD void limit(const Vec3& direction, const Vec3& middle, Real width) {
    side[count++] = rounded(HalfSpace{direction, dot(direction, middle) + width});
    side[count++] = rounded(HalfSpace{-direction, width - dot(direction, middle)});
    half_width = width;
  }
};

/// `plane` in the frame in which the wall's point lies at `point`.
TALUS_HD inline CurvedWindow ball_window(const WallRecord& wall, const Vec3& point, const HalfSpace& plane) {
  CurvedWindow window;
  const Real depth = depth_below(plane, point);
  const Real square = wall.base_radius * wall.base_radius - depth * depth;
  window.is_empty = square <= 0;
  if (window.is_empty) return window;
  const Vec3 u = any_perpendicular(plane.normal);
  window.limit(u, point, std::sqrt(square));
  window.limit(cross(plane.normal, u), point, std::sqrt(square));
  return window;
}

/// Shaft or cone: within its length, and across it no wider than the plane's cut through the larger radius.
TALUS_HD inline CurvedWindow shaft_window(const WallRecord& wall, const Vec3& point, const HalfSpace& plane) {
  constexpr Real kEndOn = Real(1e-6);  // sine between axis and normal below which the plane cuts straight across
  CurvedWindow window;
  const Real radius = wall.base_radius > wall.top_radius ? wall.base_radius : wall.top_radius;
  window.limit(wall.direction, point + (wall.length / 2) * wall.direction, wall.length / 2);
  const Real along = dot(plane.normal, wall.direction);
  const Vec3 across = cross(plane.normal, wall.direction);
  const Real sine = norm(across);
  if (sine < kEndOn) {
    const Vec3 u = any_perpendicular(wall.direction);
    window.limit(u, point, radius);
    window.limit(cross(wall.direction, u), point, radius);
    return window;
  }
  // Distance of the axis from the plane's trace, at both ends.
  const Real at_base = depth_below(plane, point) / sine, at_top = at_base - along * wall.length / sine;
  const Real nearest = at_base * at_top <= 0                  ? 0
                       : std::abs(at_base) < std::abs(at_top) ? std::abs(at_base)
                                                              : std::abs(at_top);
  window.is_empty = nearest >= radius;
  if (!window.is_empty) window.limit(across / sine, point, std::sqrt(radius * radius - nearest * nearest));
  return window;
}

}  // namespace dem_gpu
