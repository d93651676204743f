// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/colour_image.h"

#include <algorithm>
#include <cmath>

namespace shape_pipeline {
namespace {

constexpr Colour kWhite{255, 255, 255};

}  // namespace

ColourImage side_by_side(const std::vector<ColourImage>& images, int gap) {
  int width = 0, height = 0;
  for (const ColourImage& image : images) {
    width += image.width + (width > 0 ? gap : 0);
    height = std::max(height, image.height);
  }
  ColourImage joined(width, height, kWhite);
  int left = 0;
  for (const ColourImage& image : images) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) joined(left + x, y) = image(x, y);
    left += image.width + gap;
  }
  return joined;
}

ColourImage shrunk(const ColourImage& image, int factor) {
  ColourImage small(image.width / factor, image.height / factor, kWhite);
  const int count = factor * factor;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      std::array<int, 3> sum{};
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += image(x * factor + i, y * factor + j)[c];
      for (std::size_t c = 0; c < 3; ++c) small(x, y)[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    }
  return small;
}

Colour numbered_colour(std::size_t number) {
  // Hues by the golden section: neighbours in number are far apart in hue, and none comes twice.
  const double hue = 6 * std::fmod(0.58 + 0.61803398875 * static_cast<double>(number), 1.0);
  const auto channel = [&](double shift) {
    const double rise = std::abs(std::fmod(hue + shift, 6.0) - 3) - 1;
    return static_cast<std::uint8_t>(std::lround(255 * (0.12 + 0.83 * std::clamp(rise, 0.0, 1.0))));
  };
  return {channel(0), channel(4), channel(2)};
}

Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour result;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(std::lround(a[c] + std::clamp(share, 0.0, 1.0) * (b[c] - a[c])));
  return result;
}

}  // namespace shape_pipeline
