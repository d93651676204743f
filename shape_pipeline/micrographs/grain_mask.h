// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// Grey values of what an image shows.
struct GreyLevels {
  double background = 0;  // its most frequent grey value
  double noise = 0;       // standard deviation about it, from the darker side
  double grain = 0;       // mean of what Otsu's threshold (1979) parts from it
  double threshold = 0;   // from which on a pixel is grain

  double contrast() const { return grain - background; }
};

/// Grains of a micrograph are lit unevenly, those that lie deep much darker than most. So the threshold stands just
/// above the background: five times its noise or a fifth of the contrast, whichever is more, at most half the contrast.
/// Where an outline runs is decided later, for each grain by its own grey.
GreyLevels grey_levels(const GreyImage& image);

/// Pixels above the threshold, without specks narrower than three pixels and pits of at most 60 pixels.
Mask grain_mask(const GreyImage& image, double threshold);

}  // namespace shape_pipeline
