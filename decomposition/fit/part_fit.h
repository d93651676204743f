// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "decomposition/geometry/small_hull.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// How long and how finely to fit.
struct FitPlan {
  int vertices = 32;
  int steps = 400;
  double first_step = 0.02;  // largest move of a vertex per step / diagonal; falls geometrically ...
  double last_step = 0.001;  // ... to this
  int samples_along = 4;     // at most this squared sample points a face
  double volume = 0;         // volume the part is steered to [m3]; 0: least symmetric difference only
  std::uint64_t seed = 1;
  bool revives = true;  // put vertices that fell inside the hull back on it
};

/// A convex polyhedron in a cell: the hull of `points`, all of them hull vertices.
struct PartFit {
  std::vector<Vec3> points;
  double volume = 0;
  bool is_valid() const { return !points.empty(); }
};

/// Start points on the region's ellipsoid of inertia, moved to the solid's surface and into the cell.
std::vector<Vec3> start_points(const Solid& solid, const RegionMoments& region, const std::vector<Plane>& cell,
                               const FitPlan& plan);

/// Moves the points so that the symmetric difference of their hull and the solid inside `cell` becomes least.
/// `centre` must lie in the cell. An empty fit if the hull collapses.
PartFit fit_part(const Solid& solid, const std::vector<Plane>& cell, const Vec3& centre, std::vector<Vec3> points,
                 const FitPlan& plan);

/// Moves p the least way (nearly) into the cell, `margin` behind every plane.
Vec3 project_into_cell(Vec3 p, const std::vector<Plane>& cell, const Vec3& centre, double margin);

}  // namespace decomposition
