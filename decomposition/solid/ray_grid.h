// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

/// A bundle of rays along z: ray (i, j) stands in cell (i, j) of a grid in x and y.
struct RayGrid {
  double x0 = 0, y0 = 0;  // low corner of cell (0, 0)
  double cell = 1;        // edge of a square cell
  int nx = 0, ny = 0;
  std::vector<double> shift_x, shift_y;  // (nx * ny) place of the ray in its cell [0, 1); empty: the middle

  int count() const { return nx * ny; }
  double x(int i, int j) const { return x0 + cell * (i + (shift_x.empty() ? 0.5 : shift_x[index(i, j)])); }
  double y(int i, int j) const { return y0 + cell * (j + (shift_y.empty() ? 0.5 : shift_y[index(i, j)])); }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
};

struct ZInterval {
  double low, high;
};

/// The stretches of every ray that lie inside a solid, in ascending order.
struct RayIntervals {
  std::vector<std::size_t> first;    // (n_rays + 1) index of a ray's first interval
  std::vector<ZInterval> intervals;  // exact along the ray: where the winding number is positive
  double repeated = 0;               // length over all rays times what the winding number exceeds 1 by
  double inverted = 0;               // length over all rays times what it falls short of 0 by
};

/// Intersects the rays with a closed surface given as vertices and faces (outward normals). A ray through an edge
/// shared by two triangles meets exactly one of them.
RayIntervals intersect(const RayGrid& grid, const std::vector<Vec3>& vertices,
                       const std::vector<std::array<int, 3>>& faces);

}  // namespace decomposition
