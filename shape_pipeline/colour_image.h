// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shape_pipeline {

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

/// Pixels in rows from the top; x to the right, y down.
struct ColourImage {
  int width = 0, height = 0;
  std::vector<Colour> pixels;  // width * height

  ColourImage() = default;
  ColourImage(int w, int h, Colour colour)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), colour) {}

  Colour& operator()(int x, int y) { return pixels[index(x, y)]; }
  const Colour& operator()(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// The image as a PNG of 8 bits a channel: the same bytes for the same pixels.
std::string encoded_png(const ColourImage& image);

/// Images of one height side by side, `gap` white pixels between them.
ColourImage side_by_side(const std::vector<ColourImage>& images, int gap);

/// The mean of each square of `factor` x `factor` pixels.
ColourImage shrunk(const ColourImage& image, int factor);

/// A colour of its own for each number from 0 on, bright enough to be told from grey.
Colour numbered_colour(std::size_t number);

/// From `a` (share 0) to `b` (share 1).
Colour mixed(const Colour& a, const Colour& b, double share);

}  // namespace shape_pipeline
