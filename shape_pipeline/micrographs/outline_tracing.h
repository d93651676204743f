// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shape_pipeline/micrographs/grain_mask.h"
#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

/// The closed lines where a field on pixels is 0, inside above 0; below 0 beyond the border. Marching squares (Lorensen
/// & Cline 1987, in the plane), saddles parted by the mean of their corners. In pixels, (0, 0) at the upper left corner
/// of the image, so that the first pixel's centre lies at (0.5, 0.5).
std::vector<Outline> level_lines(const Raster<float>& field);

/// The one of them that encloses most; empty if nothing is inside.
Outline level_outline(const Raster<float>& field);

/// Outline of each region, by label (that of 0 is empty), finer than pixels: where the grey passes halfway between the
/// background and the region's own (region_greys), and towards other
/// regions along the seam, smoothed by a Gaussian of 1.2 pixels. Pores inside are filled. `grey` should be smoothed by
/// a pixel or so: noise makes perimeters long.
std::vector<Outline> region_outlines(const LabelImage& regions, const GreyImage& grey, const GreyLevels& levels);

}  // namespace shape_pipeline
