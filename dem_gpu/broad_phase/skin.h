// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "dem_gpu/core/real.h"

namespace dem_gpu {

/// Limits of the neighbour list's skin, and where it begins, in mean body diameters. Periodic boxes keep the first.
inline constexpr Real kFirstSkin = 0.1, kLeastSkin = 0.04, kLargestSkin = 0.5;

/// The skin for the next list after one with `skin` that lasted `steps` steps [m]. Bodies that use up u of it in a step
/// make a list last skin / u steps; candidate pairs grow by 3 / diameter of a skin for thin ones. With `list_cost`, of
/// a list over that of testing its candidates in one step, the sum is least at sqrt(list_cost u diameter / 3). It
/// follows slowly, as one list tells little. Counts of steps, not times, so that every run does the same; what bodies
/// do does not depend on it.
inline Real next_skin(Real skin, std::int64_t steps, Real mean_diameter, Real list_cost) {
  constexpr Real kMostChange = 1.25;
  const Real used = skin / static_cast<Real>(std::max<std::int64_t>(steps, 1));
  const Real best = std::sqrt(list_cost * used * mean_diameter / 3);
  const Real next = std::clamp(best, skin / kMostChange, skin * kMostChange);
  return std::clamp(next, kLeastSkin * mean_diameter, kLargestSkin * mean_diameter);
}

}  // namespace dem_gpu
