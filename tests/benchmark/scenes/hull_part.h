// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "catalog/convex_part.h"
#include "dem_gpu/scene.h"

namespace benchmark_scenes {

/// Convex hull of a few points by trying every plane through three of them: exact enough, and slow enough (n^4), for
/// the shapes of benchmark scenes. Points within the hull or its faces are left out; all faces are outer.
catalog::ConvexPart hull_part(const std::vector<dem_gpu::Vec3>& points);

/// Box between two corners, all faces outer.
catalog::ConvexPart box_between(const dem_gpu::Vec3& low, const dem_gpu::Vec3& high);

/// The face whose outward normal is nearest to `direction`.
catalog::ConvexFace& face_towards(catalog::ConvexPart& part, const dem_gpu::Vec3& direction);

}  // namespace benchmark_scenes
