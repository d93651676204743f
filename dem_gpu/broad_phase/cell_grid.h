// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/body_columns.h"
#include "dem_gpu/core/parallel.h"

namespace dem_gpu {

/// Uniform grid over the active bodies: bodies sorted by cell. Cells are 64-bit keys, so memory does not depend on the
/// extent of the scene; a column of cells along z is one run of keys. Cells are counted from the lowest body, 2^21
/// along an axis at most: beyond that they grow.
class CellGrid {
 public:
  struct View {
    const std::int64_t* cell;  // ascending, n_active used
    const int* body;           // body of each entry
    int count;
    Vec3 origin;
    Real size;  // edge of a cell [m]

    TALUS_HD int coordinate(Real x) const { return static_cast<int>(std::floor(x / size)); }
    TALUS_HD std::int64_t key(int x, int y, int z) const {
      return (static_cast<std::int64_t>(x) << 42) | (static_cast<std::int64_t>(y) << 21) | static_cast<std::int64_t>(z);
    }
    TALUS_HD std::int64_t key_of(const Vec3& position) const {
      return key(coordinate(position.x - origin.x), coordinate(position.y - origin.y),
                 coordinate(position.z - origin.z));
    }

    /// visitor(j) for each body j in the 27 cells about `position`.
    template <class Visitor>
    TALUS_HD void visit_neighbours(const Vec3& position, Visitor&& visitor) const {
      const int cx = coordinate(position.x - origin.x), cy = coordinate(position.y - origin.y),
                cz = coordinate(position.z - origin.z);
      for (int x = cx - 1; x <= cx + 1; ++x)
        for (int y = cy - 1; y <= cy + 1; ++y) {
          const std::int64_t last = key(x, y, cz + 1);
          for (int k = lower_bound(cell, count, key(x, y, cz - 1)); k < count && cell[k] <= last; ++k) visitor(body[k]);
        }
    }
  };

  /// `cell_size` at least the largest distance at which two bodies are neighbours [m].
  void build(const BodyView& bodies, Real cell_size);
  View view() const { return {pointer(cell_), pointer(body_), count_, origin_, cell_size_}; }

 private:
  DeviceVector<std::int64_t> cell_;
  DeviceVector<int> body_;
  DeviceVector<Real> coordinate_;
  int count_ = 0;
  Vec3 origin_;
  Real cell_size_ = 0;
};

}  // namespace dem_gpu
