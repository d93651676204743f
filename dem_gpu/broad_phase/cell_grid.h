// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/parallel.h"
#include "dem_gpu/core/real_lanes.h"

namespace dem_gpu {

/// Bodies sorted by size class and cell. Class 0 has the largest bodies; the cells of each class are half as wide as
/// those of the one before and hold any two neighbours of the class within one cell of each other, so that a few large
/// bodies among many small ones cost little. Cells are 64-bit keys: memory does not depend on the extent of the scene,
/// and a column of cells along z is one run of keys. Cells are counted from the lowest body, 2^19 along an axis at
/// most: beyond that they grow.
class CellGrid {
 public:
  static constexpr int kMostClasses = 24;

  struct SizeClass {
    int first = 0, last = 0;  // entries
    Real cell = 0;            // edge of a cell [m]
  };

  /// Entries of one column of cells.
  struct Run {
    int first;
    std::int64_t last_cell;
  };

  struct View {
    const std::int64_t* cell;  // of each entry, ascending, n_active used, then at least kRealLanes above all cells
    const int* body;           // of each entry
    const Real *x, *y, *z;     // of each entry [m]
    const Real* reach;         // of each entry: bounding radius + half the skin [m]
    int count;
    int class_count;
    Vec3 origin;
    Real skin;  // [m]
    SizeClass classes[kMostClasses];

    TALUS_HD static std::int64_t key(int size_class, int x, int y, int z) {
      return (static_cast<std::int64_t>(size_class) << 57) | (static_cast<std::int64_t>(x) << 38) |
             (static_cast<std::int64_t>(y) << 19) | static_cast<std::int64_t>(z);
    }
    /// Of a key to that of the cell so far away in the same class.
    TALUS_HD static std::int64_t offset(int x, int y, int z) {
      return static_cast<std::int64_t>(x) * (std::int64_t{1} << 38) + static_cast<std::int64_t>(y) * (1 << 19) + z;
    }
    TALUS_HD static int class_of_key(std::int64_t key) { return static_cast<int>(key >> 57); }
    TALUS_HD int class_of(Real radius) const {
      int size_class = 0;
      while (size_class + 1 < class_count && 2 * radius + skin <= classes[size_class + 1].cell) ++size_class;
      return size_class;
    }
    TALUS_HD std::int64_t key_of(const Vec3& position, Real radius) const {
      const int size_class = class_of(radius);
      const Vec3 x = (1 / classes[size_class].cell) * (position - origin);
      return key(size_class, static_cast<int>(x.x), static_cast<int>(x.y), static_cast<int>(x.z));
    }
  };

  void build(const BodyView& bodies, Real skin);
  View view() const;

 private:
  DeviceVector<std::int64_t> cell_;
  DeviceVector<int> body_;
  DeviceVector<Real> coordinate_, x_, y_, z_, reach_;
  SizeClass classes_[kMostClasses];
  int class_count_ = 0;
  int count_ = 0;
  Vec3 origin_;
  Real skin_ = 0;
};

/// Neighbours of entries of a grid in ascending order of entries, each pair of one class met once, at the entry that
/// comes first; a body of a smaller class meets those of larger ones. Runs of cells move along with the entries.
class NeighbourSearch {
 public:
  TALUS_HD explicit NeighbourSearch(const CellGrid::View& grid) : grid_(grid) {}

  /// visitor(other entry) for each neighbour closer than the sum of bounding radii and the skin.
  template <class Visitor>
  TALUS_HD void visit(int entry, Visitor&& visitor) {
    using View = CellGrid::View;
    const std::int64_t cell = grid_.cell[entry];
    visit_run(entry, entry + 1, cell + 1, visitor);
    const std::int64_t columns[kColumns] = {View::offset(0, 1, -1), View::offset(1, -1, -1), View::offset(1, 0, -1),
                                            View::offset(1, 1, -1)};
    for (int column = 0; column < kColumns; ++column) {
      first_[column] = move_to(first_[column], cell + columns[column]);
      visit_run(entry, first_[column], cell + columns[column] + 2, visitor);
    }
    for (int larger = 0; larger < View::class_of_key(cell); ++larger) visit_larger(entry, larger, visitor);
  }

 private:
  static constexpr int kColumns = 4;  // that follow an entry's own

  TALUS_HD int move_to(int first, std::int64_t cell) const {
    constexpr int kSteps = 8;
    if (first >= 0)
      for (int step = 0; step < kSteps; ++step, ++first)
        if (grid_.cell[first] >= cell) return first;
    first = first < 0 ? 0 : first;
    return first + lower_bound(grid_.cell + first, grid_.count - first, cell);
  }

  template <class Visitor>
  TALUS_HD TALUS_ALL_INLINED void visit_run(int entry, int first, std::int64_t last_cell, Visitor& visitor) const {
    const Real x = grid_.x[entry], y = grid_.y[entry], z = grid_.z[entry], reach = grid_.reach[entry];
    for (int k = first; grid_.cell[k] <= last_cell; k += kRealLanes) {
      const RealLanes dx = load_lanes_at(grid_.x + k) - x, dy = load_lanes_at(grid_.y + k) - y,
                      dz = load_lanes_at(grid_.z + k) - z, sum = load_lanes_at(grid_.reach + k) + reach;
      unsigned near =
          bits_of(dx * dx + dy * dy + dz * dz < sum * sum) & bits_of(load_lanes_at(grid_.cell + k) <= last_cell);
      for (; near != 0; near &= near - 1) visitor(k + lowest_bit(near));
    }
  }

  /// The cells of a class of larger bodies that hold neighbours.
  template <class Visitor>
  TALUS_HD void visit_larger(int entry, int larger, Visitor& visitor) const {
    const CellGrid::SizeClass& size = grid_.classes[larger];
    if (size.first == size.last) return;
    const Real reach = grid_.reach[entry] + size.cell / 2, scale = 1 / size.cell;
    const auto low = [&](Real x, Real origin) { return static_cast<int>((x - reach - origin) * scale); };
    const auto high = [&](Real x, Real origin) { return static_cast<int>((x + reach - origin) * scale); };
    const Vec3& origin = grid_.origin;
    const int first_z = low(grid_.z[entry], origin.z), last_z = high(grid_.z[entry], origin.z);
    for (int x = low(grid_.x[entry], origin.x); x <= high(grid_.x[entry], origin.x); ++x)
      for (int y = low(grid_.y[entry], origin.y); y <= high(grid_.y[entry], origin.y); ++y) {
        const std::int64_t first_cell = CellGrid::View::key(larger, x, y, first_z);
        const int first = size.first + lower_bound(grid_.cell + size.first, size.last - size.first, first_cell);
        visit_run(entry, first, first_cell + (last_z - first_z), visitor);
      }
  }

  const CellGrid::View& grid_;
  int first_[kColumns] = {-1, -1, -1, -1};  // of the runs at the last entry; none yet
};

}  // namespace dem_gpu
