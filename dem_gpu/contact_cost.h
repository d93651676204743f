// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dem_gpu {

/// Time of a touching pair of two like bodies of `parts` convex parts with `faces` faces in all under the depth
/// potential, over that of a pair of cubes [-]. A fit to two scanned rocks at 1 to 32 parts of at most 16 to 64
/// vertices (`talus bench levels --catalog FILE`): right within a fifth. Few parts and few faces of a body touch at
/// once.
inline double contact_cost(int parts, int faces) {
  constexpr double kCubeFaces = 6, kFaceExponent = 0.84, kPartExponent = -0.37;
  return std::pow(faces / kCubeFaces, kFaceExponent) * std::pow(parts, kPartExponent);
}

}  // namespace dem_gpu
