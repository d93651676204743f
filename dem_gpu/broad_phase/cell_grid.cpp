// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/broad_phase/cell_grid.h"

#include <algorithm>
#include <limits>

namespace dem_gpu {
namespace {

/// Cells along an axis that a key has room for, with the margin.
constexpr Real kMostCells = (1 << 19) - 8;
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

struct Radius {
  BodyView bodies;
  Real sign;
  Real* radius;

  TALUS_HD void operator()(int i) const {
    radius[i] = bodies.active[i] ? sign * bodies.bounding_radius[i] : Real(1e300);
  }
};

struct AssignCell {
  BodyView bodies;
  CellGrid::View grid;
  std::int64_t* cell;
  int* body;

  TALUS_HD void operator()(int i) const {
    cell[i] = bodies.active[i] ? grid.key_of(bodies.position[i], bodies.bounding_radius[i]) : kNoCell;
    body[i] = i;
  }
};

/// What the search reads of the bodies, in the order of the entries.
struct CopyEntry {
  BodyView bodies;
  const int* body;
  Real skin;
  Real *x, *y, *z, *reach;

  TALUS_HD void operator()(int entry) const {
    const Vec3 position = bodies.position[body[entry]];
    x[entry] = position.x;
    y[entry] = position.y;
    z[entry] = position.z;
    reach[entry] = bodies.bounding_radius[body[entry]] + skin / 2;
  }
};

}  // namespace

CellGrid::View CellGrid::view() const {
  View view{pointer(cell_), pointer(body_), pointer(x_), pointer(y_), pointer(z_), pointer(reach_),
            count_,         class_count_,   origin_,     skin_,       {}};
  std::copy(classes_, classes_ + kMostClasses, view.classes);
  return view;
}

void CellGrid::build(const BodyView& bodies, Real skin) {
  const auto n = static_cast<std::size_t>(bodies.count);
  cell_.resize(n);
  body_.resize(n);
  coordinate_.resize(n);
  const auto least = [&](int axis, Real sign) {
    parallel_for(0, bodies.count, Coordinate{bodies, axis, sign, pointer(coordinate_)});
    return min_of(coordinate_, Real(0));
  };
  const auto least_radius = [&](Real sign) {
    parallel_for(0, bodies.count, Radius{bodies, sign, pointer(coordinate_)});
    return min_of(coordinate_, Real(0));
  };
  Real low[3], extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = least(axis, 1);
    extent = std::max(extent, -least(axis, -1) - low[axis]);
  }
  // Coarser cells where bodies lie millions of sizes apart: more candidates to sift, none lost.
  const Real narrowest = extent / kMostCells;
  const Real largest = std::max(2 * -least_radius(-1) + skin, narrowest),
             smallest = std::max(2 * least_radius(1) + skin, narrowest);
  skin_ = skin;
  class_count_ = 0;
  for (Real cell = largest; class_count_ < kMostClasses; cell /= 2) {
    classes_[class_count_++] = {0, 0, cell};
    if (cell / 2 < smallest) break;
  }
  // Two cells of margin keep all cell coordinates positive, neighbours included.
  origin_ = Vec3{low[0], low[1], low[2]} - 2 * largest * Vec3{1, 1, 1};
  parallel_for(0, bodies.count, AssignCell{bodies, view(), pointer(cell_), pointer(body_)});
  sort_by_key(cell_, body_);
  std::array<std::int64_t, kMostClasses + 2> bounds;  // of the classes, and of all
  for (int size_class = 0; size_class <= kMostClasses; ++size_class)
    bounds[static_cast<std::size_t>(size_class)] = View::key(size_class, 0, 0, 0);
  bounds.back() = kNoCell;
  const std::vector<int> below = counts_below(cell_, bounds);
  count_ = below.back();
  for (int size_class = 0; size_class < class_count_; ++size_class) {
    const auto first = static_cast<std::size_t>(size_class);
    classes_[size_class] = {below[first], std::min(count_, below[first + 1]), classes_[size_class].cell};
  }
  // Whole registers are read from any entry on.
  const std::size_t padded = n + kRealLanes;
  cell_.resize(padded, kNoCell);
  for (DeviceVector<Real>* column : {&x_, &y_, &z_, &reach_}) column->resize(padded);
  parallel_for(0, count_,
               CopyEntry{bodies, pointer(body_), skin, pointer(x_), pointer(y_), pointer(z_), pointer(reach_)});
}

}  // namespace dem_gpu
