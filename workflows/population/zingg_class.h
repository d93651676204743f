// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace workflows {

/// Classes of form, parted at 2/3 of S/I and of I/L (Zingg 1935). A ratio of exactly 2/3 counts as below.
inline constexpr std::array kZinggClasses{"sphere", "disc", "rod", "blade"};

/// Place among kZinggClasses; the ratios are above 0 and at most 1.
inline std::size_t zingg_class(double s_over_i, double i_over_l) {
  constexpr double kParting = 2.0 / 3;
  return (s_over_i > kParting ? 0u : 1u) + (i_over_l > kParting ? 0u : 2u);
}

}  // namespace workflows
