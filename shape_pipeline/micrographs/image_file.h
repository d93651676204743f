// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "shape_pipeline/colour_image.h"
#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {

/// Reads a PNG, JPEG, BMP or one-page TIFF of 8 or 16 bits, grey or in colour (by luminance), as grey values from 0 to
/// 255: those of 8 bits as they are, those of 16 stretched between the darkest and brightest thousandth. Throws
/// InputError, the file named, for what is empty, ends early, is none of these, or smaller than 32 pixels a side.
GreyImage read_image(const std::filesystem::path& path);

/// An image as it is stored, one channel.
struct GreySlice {
  int width = 0, height = 0;  // [pixels]
  int bytes = 1;              // a value: 1 or 2
  std::string samples;        // row by row, in this machine's order of bytes
};

/// Reads a PNG, JPEG or BMP. Throws InputError as read_image(), and for colours.
GreySlice read_slice(const std::filesystem::path& path);

/// Writes the image as PNG of 8 bits. Throws InputError if it cannot.
void write_image(const std::filesystem::path& path, const GreyImage& image);

/// A picture with three channels a pixel, for drawing on.
struct ColourLine {
  std::vector<std::array<double, 2>> points;  // in pixels, (0, 0) at the image's upper left corner
  std::array<int, 3> colour{};                // red, green, blue
  bool is_closed = true;
};

/// The image `scale` times as large with lines over it.
ColourImage picture_of(const GreyImage& image, const std::vector<ColourLine>& lines, double scale);

/// Writes the image as PNG, twice as large a side up to 3,200 pixels, with lines over it. Throws InputError if it
/// cannot.
void write_picture(const std::filesystem::path& path, const GreyImage& image, const std::vector<ColourLine>& lines);

}  // namespace shape_pipeline
