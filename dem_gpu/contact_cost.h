// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dem_gpu {

/// Time of a touching pair of two like bodies of `parts` convex parts with `faces` faces in all under the depth
/// potential, over that of a pair of cubes [-]. A fit to scanned rocks at 1 to 32 parts of at most 16 to 64 vertices
/// (`talus bench levels --catalog FILE`): right within a third. More parts cost less than their faces, since few of
/// them touch.
inline double contact_cost(int parts, int faces) {
  constexpr double kCubeFaces = 6, kSharedByParts = 0.35;
  return faces / kCubeFaces * std::pow(parts, -kSharedByParts);
}

}  // namespace dem_gpu
