// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dem_gpu/scene.h"

namespace dem_gpu {

/// The part of volume object `wall` with those faces made inner that lie wholly within another wall of the same motion:
/// a lifter's foot in its shell, the seam of two flush blocks. Depth is not measured from them, so a welded joint is
/// not felt.
catalog::ConvexPart welded_part(const Scene& scene, std::size_t wall);

/// For each wall, the others that are one solid with it: of the same motion, touching it. Meshes are left out, and
/// walls without a volume object among them: those have no seams.
std::vector<std::vector<int>> welded_walls(const Scene& scene);

}  // namespace dem_gpu
