// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shape_pipeline/outline_descriptors.h"

namespace test_support {

struct DrawnGrain {
  double x = 0, y = 0, half_length = 0, half_width = 0;  // of an ellipse [pixels]
  double angle = 0;                                      // of its length to x, towards y [rad]
  double grey = 160;
};

/// A micrograph with known grains: those drawn later lie in front. Pixels hold their share of each grain, are blurred
/// and get noise.
struct DrawnMicrograph {
  int width = 200, height = 160;
  std::vector<DrawnGrain> grains;
  double background = 30, blur = 0.8, noise = 4;  // grey values, pixels, grey values
  std::uint64_t seed = 1;
  int strip = 0;                 // rows of a black data strip below, with letters
  std::array<int, 2> bar{0, 0};  // first and last pixel + 1 of the white bar in it
};

enum class PixelKind { grey_8, grey_16, colour_8 };

/// Writes it in the format of the path's ending.
void write_drawn(const std::filesystem::path& path, const DrawnMicrograph& drawing, PixelKind kind = PixelKind::grey_8);

/// Pixels of one grey value in the format of the path's ending.
void write_uniform(const std::filesystem::path& path, int width, int height, int grey);

/// The ellipse as a polygon of 256 corners.
shape_pipeline::Outline outline_of(const DrawnGrain& grain);

}  // namespace test_support
