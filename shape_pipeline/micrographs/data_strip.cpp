// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/data_strip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shape_pipeline {
namespace {

constexpr double kTallestStrip = 0.25;  // of the image
constexpr int kLowestStrip = 8;         // [pixels]; lower ones hold no text
constexpr float kSameGrey = 3;          // what compression leaves of a plain colour
constexpr double kPlainShare = 0.5;     // of a row of the strip; the rest is text
constexpr double kOtherShare = 0.2;     // of a row above it
constexpr int kEdgeRows = 3;            // over which compression spreads the strip's edge
constexpr double kFrameShare = 0.9;     // of the image's width
constexpr double kSlenderness = 8;      // length / thickness of a bar
constexpr double kLeastBar = 0.03;      // of the image's width; shorter lines are letters

float commonest_grey(const GreyImage& image, int first_row) {
  std::array<int, 256> counts{};
  for (int y = first_row; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      ++counts[static_cast<std::size_t>(std::clamp(std::lround(image(x, y)), 0l, 255l))];
  return static_cast<float>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

double share_of(const GreyImage& image, int y, float grey) {
  int same = 0;
  for (int x = 0; x < image.width; ++x) same += std::abs(image(x, y) - grey) <= kSameGrey;
  return static_cast<double>(same) / image.width;
}

/// Ends [first, last) of the longest run of a row that differs from the strip's colour by half the contrast.
std::array<int, 2> longest_run(const GreyImage& image, int y, float plain, float half) {
  std::array<int, 2> best{0, 0};
  for (int x = 0, start = 0; x <= image.width; ++x) {
    if (x < image.width && std::abs(image(x, y) - plain) > half) continue;
    if (x - start > best[1] - best[0]) best = {start, x};
    start = x + 1;
  }
  return best;
}

}  // namespace

int data_strip_top(const GreyImage& image) {
  const float plain = commonest_grey(image, image.height - 4);
  const int highest = image.height - static_cast<int>(kTallestStrip * image.height);
  int top = image.height;
  while (top > highest && share_of(image, top - 1, plain) >= kPlainShare) --top;
  if (top == highest || image.height - top < kLowestStrip) return image.height;
  for (int y = top - 1; y >= std::max(0, top - kEdgeRows); --y)
    if (share_of(image, y, plain) < kOtherShare) return y + 1;
  return image.height;
}

std::optional<ScaleBar> find_scale_bar(const GreyImage& image, int strip_top) {
  if (strip_top >= image.height) return std::nullopt;
  const float plain = commonest_grey(image, strip_top);
  float farthest = 0;
  for (int y = strip_top; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) farthest = std::max(farthest, std::abs(image(x, y) - plain));
  ScaleBar best;
  for (int y = strip_top; y < image.height;) {
    const std::array<int, 2> run = longest_run(image, y, plain, farthest / 2);
    int rows = 1;
    while (y + rows < image.height && longest_run(image, y + rows, plain, farthest / 2) == run) ++rows;
    const double length = run[1] - run[0];
    if (length > best.length() && length >= kSlenderness * rows && length >= kLeastBar * image.width &&
        length <= kFrameShare * image.width)
      best = {static_cast<double>(run[0]), static_cast<double>(run[1]), y, rows};
    y += rows;
  }
  if (best.length() == 0) return std::nullopt;
  // What the pixels at the ends and beyond hold of the bar's grey is a part of its length.
  const int left = static_cast<int>(best.left), right = static_cast<int>(best.right), y = best.top + best.rows / 2;
  const float bar = image((left + right) / 2, y);
  const auto part = [&](int x) {
    return x < 0 || x >= image.width ? 0.0 : std::clamp((image(x, y) - plain) / (bar - plain), 0.0f, 1.0f);
  };
  best.left += 1 - part(left) - part(left - 1);
  best.right -= 1 - part(right - 1) - part(right);
  return best;
}

}  // namespace shape_pipeline
