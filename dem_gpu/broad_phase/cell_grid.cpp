// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/cell_grid.h"

#include <algorithm>
#include <limits>

namespace dem_gpu {
namespace {

/// Cells along an axis that a key has room for, with the margin.
constexpr Real kMostCells = (1 << 21) - 8;
constexpr std::int64_t kNoCell = std::numeric_limits<std::int64_t>::max();

struct Coordinate {
  BodyView bodies;
  int axis;
  Real sign;  // -1: mirrored, so that one reduction finds both ends
  Real* coordinate;

  TALUS_HD void operator()(int i) const {
    const Vec3 x = bodies.position[i];
    const Real value = axis == 0 ? x.x : axis == 1 ? x.y : x.z;
    coordinate[i] = bodies.active[i] ? sign * value : Real(1e300);
  }
};

struct AssignCell {
  BodyView bodies;
  CellGrid::View grid;
  std::int64_t* cell;
  int* body;

  TALUS_HD void operator()(int i) const {
    cell[i] = bodies.active[i] ? grid.key_of(bodies.position[i]) : kNoCell;
    body[i] = i;
  }
};

}  // namespace

void CellGrid::build(const BodyView& bodies, Real cell_size) {
  const auto n = static_cast<std::size_t>(bodies.count);
  cell_.resize(n);
  body_.resize(n);
  coordinate_.resize(n);
  const auto least = [&](int axis, Real sign) {
    parallel_for(0, bodies.count, Coordinate{bodies, axis, sign, pointer(coordinate_)});
    return min_of(coordinate_, Real(0));
  };
  Real low[3], extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = least(axis, 1);
    extent = std::max(extent, -least(axis, -1) - low[axis]);
  }
  // Coarser cells where bodies lie millions of sizes apart: more candidates to sift, none lost.
  cell_size = std::max(cell_size, extent / kMostCells);
  cell_size_ = cell_size;
  // Two cells of margin keep all cell coordinates positive, neighbours included.
  origin_ = Vec3{low[0], low[1], low[2]} - 2 * cell_size * Vec3{1, 1, 1};
  parallel_for(0, bodies.count, AssignCell{bodies, view(), pointer(cell_), pointer(body_)});
  sort_by_key(cell_, body_);
  count_ = count_below(cell_, kNoCell);
}

}  // namespace dem_gpu
