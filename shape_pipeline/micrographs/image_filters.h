// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// Convolved with a Gaussian of this standard deviation [pixels].
GreyImage blurred(const GreyImage& image, double sigma);

/// Length of the gradient of grey values, by Sobel's operator [grey values a pixel].
GreyImage gradient_length(const GreyImage& image);

/// Distance of each pixel's centre to the nearest centre of a pixel outside; beyond the border is no outside.
DistanceImage distance_to_outside(const Mask& mask);

/// The mask without what is narrower than three pixels.
Mask opened(const Mask& mask);

/// Regions of pixels that are 0, joined by their sides, each of an area of at most `largest` set to 255.
void fill_pits(Mask& mask, int largest);

/// The region of pixels set, joined by their sides, that has most of them; of equals the first.
Mask largest_region(const Mask& mask);

}  // namespace shape_pipeline
