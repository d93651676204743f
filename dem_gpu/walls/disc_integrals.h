// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "dem_gpu/narrow_phase/placed_part.h"
#include "dem_gpu/walls/wall_integrals.h"

namespace dem_gpu {

/// Sides of the regular polygon of equal area that stands for a disc's rim: at most 0.11 % of the radius off it.
constexpr int kDiscSides = 48;

/// Adds one convex part of a body to a disc's integrals, world axes about the body's centre. Without a thickness depth
/// is that below the face, whatever the rim; a plate's depth is the distance to its nearest side. False if a polygon
/// was truncated.
template <class Integrals>
TALUS_HD bool integrate_part_in_disc(const PlacedPart& body, const Vec3& body_centre, const WallRecord& wall,
                                     Integrals& integrals) {
  constexpr Real kTurn = 2 * std::numbers::pi_v<Real> / kDiscSides;
  const Vec3 to_centre = wall.point - body_centre;
  const auto plane = [&](const Vec3& normal, Real from_centre) {
    return rounded(HalfSpace{normal, dot(normal, to_centre) + from_centre});
  };
  ScratchArray<LocalHalfSpace, kDiscSides + 2> planes;
  const Real apothem = wall.base_radius * std::sqrt(std::numbers::pi_v<Real> / (kDiscSides * std::tan(kTurn / 2)));
  const Vec3 side = rotate(wall.orientation, wall.side), other = cross(wall.direction, side);
  int count = 0;
  planes[count++] = plane(wall.direction, 0);
  for (int k = 0; k < kDiscSides; ++k)
    planes[count++] = plane(std::cos(k * kTurn) * side + std::sin(k * kTurn) * other, apothem);
  if (wall.thickness > 0) planes[count++] = plane(-wall.direction, wall.thickness);
  const int field_planes = wall.thickness > 0 ? count : 1;
  bool is_whole = true;
  const bool is_clipped = visit_part_inside(body, planes.data(), count, [&](const Polygon& polygon, int face) {
    visit_least_depth(polygon, planes.data(), field_planes, [&](const Polygon& piece, const LocalHalfSpace& nearest) {
      is_whole &= !piece.is_truncated;
      integrals.add_polygon(piece, nearest, body.face_normal(face), face < body.part.range.outer_face_count);
    });
  });
  return is_clipped && is_whole;
}

}  // namespace dem_gpu
