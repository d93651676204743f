// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// One grain's silhouette, finer than pixels; (0, 0) at the upper left corner of the image, rows downwards.
struct SilhouetteImage {
  DistanceImage distance;  // of each pixel's centre to the outline, positive inside [pixels]: exact within 2.5 pixels
                           // of the outline, to about half a pixel beyond
  double left = 0, right = 0, top = 0, bottom = 0;  // of the outline
  double area = 0;                                  // less its holes [pixels^2]

  /// Signed distance of any point [pixels], inside the image bilinear.
  double at(double column, double row) const;
};

/// The largest region, its holes kept (but pits of at most 9 pixels, which are noise), that stands out from the border
/// in grey: dark on bright or bright on dark. The outline runs where the grey is halfway between the means of Otsu's
/// classes (1979), after a Gaussian of 1 pixel. Throws InputError, calling the image `name`, where nothing stands out
/// or the region touches the border.
SilhouetteImage silhouette_of(const GreyImage& image, const std::string& name);

}  // namespace shape_pipeline
