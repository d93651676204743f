// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/volumes/grain_labels.h"
#include "shape_pipeline/volumes/grey_filters.h"

namespace shape_pipeline {

/// Surface of one grain with sub-voxel accuracy: where the grey values pass the threshold, and, where it touches other
/// grains, along their smoothed common border (the labels, spread by a Gaussian of 1.2 voxels). Closed, outward, in
/// metres in the frame of the stack; every surface of the grain's voxels and of the cavities in it, in no set order.
catalog::TriangleMesh grain_surface(const GreyVolume& volume, const GreyClasses& classes, const GrainLabels& labels,
                                    std::size_t grain);

}  // namespace shape_pipeline
