// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// Triangles of the convex hull of a set of points with exact predicates (CGAL): n_faces x 3 indices into `points`,
/// counter-clockwise seen from outside, each from its least index, in ascending order. Empty if the points are flat.
std::vector<std::array<int, 3>> hull_triangles(const std::vector<Vec3>& points);

/// A planar convex polygon of a hull.
struct Facet {
  std::vector<int> vertices;  // counter-clockwise seen from outside
  Plane plane;
  int given_plane = -1;  // index into the planes given, if the facet lies on one
};

struct FacetedHull {
  std::vector<Vec3> points;  // corners only
  std::vector<int> source;   // index of each among the points given
  std::vector<Facet> facets;
};

/// Convex hull whose coplanar triangles (within `tolerance` [m]) are merged to polygons and whose points that are no
/// corner (fewer than three facets) are dropped. Facets on one of `given` planes carry it. Nothing if the points are
/// flat or the merged facets are no single polygons.
std::optional<FacetedHull> faceted_hull(std::vector<Vec3> points, const std::vector<Plane>& given, double tolerance);

}  // namespace decomposition
