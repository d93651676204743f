// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/shape_record.h"
#include "decomposition/geometry/random.h"
#include "decomposition/quality/triangle_tree.h"

namespace decomposition {

using TriangleSoup = std::vector<std::array<Vec3, 3>>;

TriangleSoup soup(const catalog::TriangleMesh& mesh);

/// Points spread over the triangles in proportion to their area, each with the number of its triangle.
struct SpreadPoints {
  std::vector<Vec3> points;         // n_points
  std::vector<std::size_t> source;  // n_points, index of the triangle
};
SpreadPoints spread_points(const TriangleSoup& triangles, int count, Random& random);

/// Distances [m] from points of the mesh to the parts' outer faces, one a point.
std::vector<double> distances_to_union(const std::vector<Vec3>& mesh_points,
                                       const std::vector<catalog::ConvexPart>& parts);

/// Distances [m] from `count` points spread over the parts to the mesh, without the points that lie in another part or
/// within `tolerance` [m] of it.
std::vector<double> distances_to_mesh(const std::vector<catalog::ConvexPart>& parts, const TriangleTree& mesh,
                                      int count, double tolerance, Random& random);

/// Mean, 95 % and largest of the distances over `length`; all zero without distances.
catalog::SurfaceDistance summary(std::vector<double> distances, double length);

/// The same of two sets together, each of the same weight; an empty one counts for nothing.
catalog::SurfaceDistance summary(std::vector<double> first, std::vector<double> second, double length);

}  // namespace decomposition
