// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace shape_pipeline {

/// gradient . step + value >= level
struct LinearBound {
  std::array<double, 3> gradient;
  double value = 0;
};

/// The step, each component of size at most `reach`, that makes the least of gradient . step + value largest.
std::array<double, 3> raising_step(const std::vector<LinearBound>& bounds, double reach);

}  // namespace shape_pipeline
