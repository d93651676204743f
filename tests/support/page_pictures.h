// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace test_support {

/// A picture as a page holds it.
struct PagePixels {
  std::string caption;
  int width = 0, height = 0;
  std::vector<std::array<int, 3>> pixels;  // red, green, blue

  std::size_t count(const std::function<bool(const std::array<int, 3>&)>& is_meant) const;
};

/// The pictures embedded in a page, in their order, decoded by OpenCV.
std::vector<PagePixels> pictures_in(const std::string& page);

}  // namespace test_support
