// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "shape_pipeline/colour_image.h"
#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

struct MicrographOptions {
  double pixel_size = 0;         // [m]; 0: from the scale bar
  double scale_bar_length = 0;   // [m] of the bar in the image's data strip; 0: there is a pixel size
  bool has_dark_grains = false;  // on a bright background; else bright on dark
  double least_diameter = 5;     // [pixels] of equal area; what is smaller is counted as a speck
};

struct MicrographGrain {
  Outline outline;  // [pixels], (0, 0) at the image's upper left corner, x to the right, y down
  std::vector<OutlineDescriptor> descriptors;  // in metres; none where the border cuts the grain
};

struct Micrograph {
  int width = 0, height = 0;            // [pixels], strip included
  int strip_top = 0;                    // first row of the data strip, which is left out; the height if there is none
  double pixel_size = 0;                // [m]
  double bar_pixels = 0;                // length of the scale bar; 0 if none was read
  Outline bar;                          // where it lies; empty if none was read
  std::vector<MicrographGrain> grains;  // whole ones, the largest first
  std::vector<MicrographGrain> at_border;  // cut by the border or the strip: no figures
  std::size_t specks = 0;                  // below the least diameter
  std::size_t films = 0;                   // too thin or too dark for grains
};

/// From a micrograph to the outlines of its grains with their descriptors: bright grains on a dark background, touching
/// ones and those behind others apart, satellites that stick to a grain its own part. Throws InputError, the file
/// named, for what cannot be read, shows no whole grain, has neither pixel size nor scale bar, or no bar to be found.
Micrograph digitize_micrograph(const std::filesystem::path& path, const MicrographOptions& options);

/// The outlines over the image as PNG: whole grains green, cut ones orange, scale bar and strip blue.
void write_overlay(const std::filesystem::path& path, const std::filesystem::path& image, const Micrograph& micrograph);

/// The same as pixels, at most `largest_side` of them a side.
ColourImage overlay(const std::filesystem::path& image, const Micrograph& micrograph, int largest_side);

/// True for the endings of images that no other scan has: png, jpg, jpeg, bmp.
bool has_image_ending(const std::filesystem::path& path);

}  // namespace shape_pipeline
