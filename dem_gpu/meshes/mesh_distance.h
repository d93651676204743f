// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/meshes/mesh_columns.h"
#include "dem_gpu/narrow_phase/closest_point.h"

namespace dem_gpu {

/// Where on a triangle the point closest to another lies.
struct FacetPoint {
  Vec3 point;       // [m]
  int edge = -1;    // from corner `edge` to the next, where it lies on that edge
  int corner = -1;  // where it is a corner
  Real square = 0;  // of the distance [m2]
};

/// Closest point of a facet to x. After Ericson, Real-Time Collision Detection (2005), section 5.1.5.
TALUS_HD inline FacetPoint closest_on_facet(const MeshView& mesh, int facet, const Vec3& x) {
  const int* corner = mesh.facets[facet].corner;
  const HalfSpace plane = mesh.planes[mesh.facets[facet].first_plane];
  FacetPoint closest;
  closest.point = x + depth_below(plane, x) * plane.normal;
  bool is_inside = true;
  FacetPoint on_edge;
  on_edge.square = Real(1e300);
  for (int e = 0; e < 3; ++e) {
    const Vec3 a = mesh.vertices[corner[e]], b = mesh.vertices[corner[(e + 1) % 3]];
    if (dot(cross(b - a, closest.point - a), plane.normal) >= 0) continue;
    is_inside = false;
    const Real share = dot(x - a, b - a) / norm_squared(b - a);
    const Vec3 point = share <= 0 ? a : share >= 1 ? b : a + share * (b - a);
    const Real square = norm_squared(x - point);
    if (square >= on_edge.square) continue;
    on_edge = {point, share > 0 && share < 1 ? e : -1, share <= 0 ? e : share >= 1 ? (e + 1) % 3 : -1, square};
  }
  if (!is_inside) return on_edge;
  closest.square = norm_squared(x - closest.point);
  return closest;
}

/// A place where a ball about x touches a mesh.
struct MeshTouch {
  Real distance = 0;  // of x from the surface, negative in the solid [m]
  Vec3 direction;     // unit, from x into the solid
};

/// Places where the surface is nearest to x, each once. The distance has a least there: an edge or a corner counts only
/// where none of its facets comes nearer, so only in its normal fan.
struct MeshTouches {
  static constexpr int kMost = 12;  // nearest first; a ball has no room for more at angles of kAlike and above
  MeshTouch touch[kMost];
  int count = 0;

  TALUS_HD void add(const MeshTouch& found) {
    int place = count < kMost ? count++ : kMost;
    for (; place > 0 && touch[place - 1].distance > found.distance; --place)
      if (place < kMost) touch[place] = touch[place - 1];
    if (place < kMost) touch[place] = found;
  }
};

/// Share of a touch beside a nearer one: none within 15 degrees of its direction (neighbours on a nearly flat surface
/// are one contact: the field is the distance to the nearest), whole from 25 degrees on. Two facets at 15 degrees
/// cannot both be touched by a ball pressed in by less than 3 % of its radius.
TALUS_HD inline Real share_beside(const MeshTouch& nearer, const MeshTouch& other) {
  constexpr Real kAlike = Real(0.9659258), kApart = Real(0.9063078);  // cosines of 15 and 25 degrees
  const Real t = (kAlike - dot(nearer.direction, other.direction)) / (kAlike - kApart);
  return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t);
}

/// Is the closest point of a facet the closest of all facets about it as well?
TALUS_HD inline bool is_nearest_of_fan(const MeshView& mesh, int facet, const FacetPoint& closest, const Vec3& x) {
  // A neighbour that shares the point finds it with other rounding.
  const Real bound = closest.square * (1 - Real(1e-9));
  if (closest.edge >= 0) return closest_on_facet(mesh, mesh.facets[facet].neighbour[closest.edge], x).square >= bound;
  if (closest.corner < 0) return true;
  const int vertex = mesh.facets[facet].corner[closest.corner];
  for (int k = mesh.fan_first[vertex]; k < mesh.fan_first[vertex + 1]; ++k)
    if (closest_on_facet(mesh, mesh.fan[k], x).square < bound) return false;
  return true;
}

/// Normal that tells outside from inside at a point of a facet: of the face, of an edge's two faces, of a corner's fan.
/// Baerentzen & Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243-253.
TALUS_HD inline Vec3 pseudonormal(const MeshView& mesh, int facet, const FacetPoint& closest) {
  const MeshFacet& own = mesh.facets[facet];
  const Vec3 normal = mesh.planes[own.first_plane].normal;
  if (closest.edge >= 0) return normal + mesh.planes[mesh.facets[own.neighbour[closest.edge]].first_plane].normal;
  return closest.corner >= 0 ? mesh.vertex_normal[own.corner[closest.corner]] : normal;
}

/// Adds the place where `facet` is nearest to x (mesh frame), if it is one and lies within `reach`.
TALUS_HD inline void add_touch(const MeshView& mesh, int facet, const Vec3& x, Real reach, MeshTouches& touches) {
  const FacetPoint closest = closest_on_facet(mesh, facet, x);
  if (closest.square >= reach * reach || !is_nearest_of_fan(mesh, facet, closest, x)) return;
  const Vec3 outward = pseudonormal(mesh, facet, closest);
  const Vec3 to_surface = closest.point - x;
  const Real distance = std::sqrt(closest.square);
  const bool is_inside = dot(to_surface, outward) > 0;
  const Vec3 plane_normal = mesh.planes[mesh.facets[facet].first_plane].normal;
  const Vec3 toward = distance > 0 ? to_surface / distance : -plane_normal;
  touches.add(is_inside ? MeshTouch{-distance, -toward} : MeshTouch{distance, toward});
}

}  // namespace dem_gpu
