// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Least distance between two parallel planes that hold the shape, over the normals of its outer faces; the diameter of
/// a sphere [m] at scale 1. The true least width may lie between two edges; it is smaller, sqrt(3/4) of
/// this for a regular tetrahedron.
Real least_width(const Shape& shape);

}  // namespace dem_gpu
