// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/shapes/surface_terms.h"

namespace dem_gpu {

/// The body's depth field in one part: the least of `planes` and of `greatest`, each the greatest of a few planes.
struct PartDepthField {
  std::vector<HalfSpace> planes;
  std::vector<GreatestDepth> greatest;
};

/// The canonical field of surface_terms(), least with `cap` [m], written with the fewest planes for each part: a plane
/// or term is left out of a part only if that provably changes the field nowhere in it. A convex body keeps the plain
/// planes of its outer faces, whatever its cut. `size`: of the body [m].
std::vector<PartDepthField> part_depth_fields(const std::vector<catalog::ConvexPart>& parts, Real size, Real cap);

}  // namespace dem_gpu
