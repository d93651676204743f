// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shape_pipeline {

/// Values of an image's pixels in rows from the top; x to the right, y down.
template <class Value>
struct Raster {
  int width = 0, height = 0;
  std::vector<Value> values;  // width * height

  Raster() = default;
  Raster(int w, int h, Value value = {})
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  Value& operator()(int x, int y) { return values[index(x, y)]; }
  const Value& operator()(int x, int y) const { return values[index(x, y)]; }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  int x_of(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(width)); }
  int y_of(std::size_t i) const { return static_cast<int>(i / static_cast<std::size_t>(width)); }
};

using GreyImage = Raster<float>;      // 0 (dark) to 255
using Mask = Raster<std::uint8_t>;    // 0 or 255
using LabelImage = Raster<int>;       // 0: background, else the number of a region
using DistanceImage = Raster<float>;  // [pixels]

}  // namespace shape_pipeline
