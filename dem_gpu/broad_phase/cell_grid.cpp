// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/cell_grid.h"

#include <limits>

namespace dem_gpu {
namespace {

constexpr std::int64_t kNoCell = std::numeric_limits<std::int64_t>::max();

struct Coordinate {
  BodyView bodies;
  int axis;
  Real* coordinate;

  TALUS_HD void operator()(int i) const {
    const Vec3 x = bodies.position[i];
    const Real value = axis == 0 ? x.x : axis == 1 ? x.y : x.z;
    coordinate[i] = bodies.active[i] ? value : Real(1e300);
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
  cell_size_ = cell_size;
  Real low[3];
  for (int axis = 0; axis < 3; ++axis) {
    parallel_for(0, bodies.count, Coordinate{bodies, axis, pointer(coordinate_)});
    low[axis] = min_of(coordinate_, Real(0));
  }
  // Two cells of margin keep all cell coordinates positive, neighbours included.
  origin_ = Vec3{low[0], low[1], low[2]} - 2 * cell_size * Vec3{1, 1, 1};
  parallel_for(0, bodies.count, AssignCell{bodies, view(), pointer(cell_), pointer(body_)});
  sort_by_key(cell_, body_);
  count_ = count_below(cell_, kNoCell);
}

}  // namespace dem_gpu
