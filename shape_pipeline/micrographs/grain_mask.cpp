// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/grain_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape_pipeline/micrographs/image_filters.h"

namespace shape_pipeline {
namespace {

constexpr double kNoises = 5;           // one pixel in 3 million of a Gaussian background passes
constexpr double kLeastContrast = 0.2;  // share of it; grains in the shade have a third
constexpr int kLargestPit = 60;         // [pixels]; gaps between touching grains are mostly larger
constexpr std::size_t kBins = 256;

std::size_t bin_of(float value) {
  return static_cast<std::size_t>(std::clamp(std::lround(value), 0l, static_cast<long>(kBins) - 1));
}

using Histogram = std::array<double, kBins>;

/// Last bin of the dark class.
std::size_t otsu_bin(const Histogram& histogram) {
  double all = 0, sum = 0, dark = 0, dark_sum = 0, best = -1;
  for (std::size_t b = 0; b < kBins; ++b) {
    all += histogram[b];
    sum += histogram[b] * static_cast<double>(b);
  }
  std::size_t bin = 0;
  for (std::size_t b = 0; b + 1 < kBins; ++b) {
    dark += histogram[b];
    dark_sum += histogram[b] * static_cast<double>(b);
    if (dark == 0 || dark == all) continue;
    const double apart = dark_sum / dark - (sum - dark_sum) / (all - dark);
    const double between = dark * (all - dark) * apart * apart;
    if (between <= best) continue;
    best = between;
    bin = b;
  }
  return bin;
}

}  // namespace

GreyLevels grey_levels(const GreyImage& image) {
  Histogram histogram{};
  for (const float value : image.values) ++histogram[bin_of(value)];
  const std::size_t otsu = otsu_bin(histogram);
  const auto about = [&](std::size_t b) {
    return histogram[b] + (b ? histogram[b - 1] : 0) + (b + 1 < kBins ? histogram[b + 1] : 0);
  };
  std::size_t mode = 0;
  for (std::size_t b = 0; b <= otsu; ++b)
    if (about(b) > about(mode)) mode = b;

  double near = 0, near_sum = 0, bright = 0, bright_sum = 0;
  for (const float value : image.values) {
    const std::size_t b = bin_of(value);
    if (b + 1 >= mode && b <= mode + 1) {
      ++near;
      near_sum += value;
    } else if (b > otsu) {
      ++bright;
      bright_sum += value;
    }
  }
  GreyLevels levels;
  levels.background = near_sum / near;
  levels.grain = bright > 0 ? bright_sum / bright : levels.background;
  double below = 0, squares = 0;
  for (const float value : image.values)
    if (value < levels.background) {
      ++below;
      squares += std::pow(levels.background - value, 2);
    }
  levels.noise = below > 0 ? std::sqrt(squares / below) : 0;
  levels.threshold = levels.background + std::min(std::max(kNoises * levels.noise, kLeastContrast * levels.contrast()),
                                                  0.5 * levels.contrast());
  return levels;
}

Mask grain_mask(const GreyImage& image, double threshold) {
  Mask mask(image.width, image.height);
  for (std::size_t i = 0; i < image.values.size(); ++i) mask.values[i] = image.values[i] > threshold ? 255 : 0;
  fill_pits(mask, kLargestPit);
  return opened(mask);
}

}  // namespace shape_pipeline
