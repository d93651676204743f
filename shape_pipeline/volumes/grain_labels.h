// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// When two peaks of the distance to the background are one grain.
struct SeparationOptions {
  double neck_ratio = 0.7;    // half width of the neck between them / that of the thinner one, above which they are one
  double least_depth = 0.75;  // the neck is that much narrower [voxels], else it is the grain of the voxels [-]
};

struct LabelledGrain {
  std::size_t voxels = 0;
  std::array<int, 3> low{}, high{};  // first and last voxel along x, y, z
  bool touches_border = false;
};

/// Voxel values of `labels`: 0 background, g + 1 for grains[g]. Grains in the order of their first voxels.
struct GrainLabels {
  std::vector<std::uint32_t> labels;
  std::vector<LabelledGrain> grains;
};

/// Voxels at or above the threshold, parted where grains touch: a flood of the distance to the background from its
/// peaks downwards (marker-controlled watershed, Meyer & Beucher 1990), in which two basins that meet become one if
/// the saddle between them is no neck. One 32-bit word a voxel, which holds first the distance and then the label,
/// beside the front of the flood (about 0.6 bytes a voxel in a packing of grains of 20 voxels, less for larger ones).
GrainLabels separate_grains(const GreyVolume& volume, double threshold, const SeparationOptions& options);

}  // namespace shape_pipeline
