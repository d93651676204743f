// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "shape_pipeline/volumes/grey_volume.h"

namespace shape_pipeline {

/// Distances are whole numbers of this share of the smallest side of a voxel: finer than what a binary mask knows.
inline constexpr int kDistanceSteps = 16;

/// Replaces a mask (0: background, else grain) by the exact distance of each grain voxel's centre to the nearest centre
/// of a background voxel (Felzenszwalb & Huttenlocher 2012), in 1 / kDistanceSteps of the smallest spacing, at least 1
/// in grains; 0 in the background. Beyond the border is no background. In place.
void distance_transform(std::vector<std::uint32_t>& voxels, const VoxelGrid& grid);

}  // namespace shape_pipeline
