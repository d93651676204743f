// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// First row of the strip of plain colour with text that microscopes add below an image, or the height where there is
/// none: rows up from the lower edge, a quarter of the image at most, half of each of one grey value, which end at a
/// row of which less than a fifth has that value.
int data_strip_top(const GreyImage& image);

/// A straight bar: pixels [left, right) of rows from `top` on.
struct ScaleBar {
  double left = 0, right = 0;  // below the pixel, from the grey of its ends
  int top = 0, rows = 0;
  double length() const { return right - left; }  // [pixels]
};

/// The longest uniform bar in the rows from `strip_top` on, eight times as long as it is thick; lines across nine
/// tenths of the image are frames, not bars. None if there is no such bar.
std::optional<ScaleBar> find_scale_bar(const GreyImage& image, int strip_top);

}  // namespace shape_pipeline
