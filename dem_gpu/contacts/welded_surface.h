// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/sphere_geometry.h"

namespace dem_gpu {

/// Nearest point of a wall, a mesh excepted.
struct WallDistance {
  Real distance = 0;  // signed, positive outside the solid [m]
  Vec3 into_wall;     // unit
};

/// One copy, so that two contacts that compare the same distances agree on them to the bit. Volume objects farther than
/// `reach` get a distance above it.
TALUS_HD TALUS_ONE_COPY inline WallDistance distance_to_wall(const ContactScene& scene, int wall, const Vec3& x,
                                                             Real reach) {
  const WallRecord& record = scene.walls[wall];
  if (record.kind != WallKind::volume_object) {
    const SurfaceDistance surface = surface_distance(record, x);
    return {-surface.depth, surface.into_wall};
  }
  const PartDistance nearest =
      distance_to_body(scene.shapes, record.shape, {rotation_matrix(record.orientation), record.point, 1}, x, reach);
  return {nearest.distance, -nearest.outward};
}

/// The wall welded to `wall` that takes over its contact with a sphere, -1 for none. The nearest point of each wall is
/// a point of the common solid's surface only if no other wall covers it, and where two walls meet in it only the
/// nearer one is touched there: so a seam is not felt, while two walls that meet in a hollow edge are both touched.
TALUS_HD inline int holder_of_contact(const ContactScene& scene, int wall, const Vec3& centre, Real radius) {
  constexpr Real kFlush = Real(1e-6);  // of the radius: rounding of scene files
  const WallRecord& record = scene.walls[wall];
  const WallDistance own = distance_to_wall(scene, wall, centre, radius);
  if (!(own.distance > 0)) return -1;
  const Vec3 nearest = centre + own.distance * own.into_wall;
  int holder = -1;
  Real least = own.distance;
  for (int k = 0; k < record.weld_count; ++k) {
    const int other = scene.welds[record.first_weld + k];
    if (!scene.walls[other].is_present) continue;
    if (distance_to_wall(scene, other, nearest, radius).distance > kFlush * radius) continue;
    const Real beside = distance_to_wall(scene, other, centre, radius).distance;
    if (beside < least || (beside == least && other < (holder < 0 ? wall : holder))) holder = other, least = beside;
  }
  return holder;
}

}  // namespace dem_gpu
