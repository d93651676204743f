// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "decomposition/solid/solid.h"

namespace decomposition {

/// Volumes of a convex polyhedron P and of its overlap with the solid, exact along the solid's z-columns.
struct ColumnOverlap {
  double volume = 0;   // V(P) [m3]
  double overlap = 0;  // V(P and solid) [m3]
  /// What P adds to the symmetric difference of a partition: V(P) - 2 V(P and solid). Adding V(solid) to the sum over
  /// the parts gives the error.
  double misfit() const { return volume - 2 * overlap; }
};

/// Rasterises convex polyhedra on the columns; keeps its buffers between calls.
class ColumnMeasure {
 public:
  /// stride: use every stride-th column in x and y.
  ColumnMeasure(const Solid& solid, int stride) : solid_(solid), stride_(stride) {}

  ColumnOverlap operator()(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces);

 private:
  void rasterise(const Vec3& a, const Vec3& b, const Vec3& c);

  const Solid& solid_;
  int stride_;
  int i0_ = 0, j0_ = 0, width_ = 0, height_ = 0;  // window of strided columns under the polyhedron
  std::vector<ZInterval> span_;                   // (height x width) of the polyhedron on each column
};

}  // namespace decomposition
