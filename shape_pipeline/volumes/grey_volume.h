// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace shape_pipeline {

/// Voxels in rows along x (columns of a slice), y (its rows), z (slices): a right-handed frame where the slices go away
/// from who looks at them. The centre of voxel (i, j, k) lies at (i, j, k) times the spacing.
struct VoxelGrid {
  std::array<int, 3> size{};        // voxels
  std::array<double, 3> spacing{};  // [m]

  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(x);
  }
  double voxel_volume() const { return spacing[0] * spacing[1] * spacing[2]; }  // [m3]
};

/// Grey values as the file has them, but for an offset that makes signed ones unsigned; real numbers in 65,536 steps.
struct GreyVolume {
  VoxelGrid grid;
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> values;  // grid.count()
  double offset = 0, step = 1;  // grey value of the file = value here * step + offset
};

}  // namespace shape_pipeline
