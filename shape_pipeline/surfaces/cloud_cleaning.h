// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// Merges points nearer than a millionth of the cloud's diagonal. Returns how many went.
std::size_t merge_duplicate_points(PointCloud& cloud);

/// Removes points whose mean distance to their neighbours is far above that of the cloud (PCL's statistical filter).
/// Returns how many.
std::size_t remove_outliers(PointCloud& cloud);

/// Keeps one point per cell so that about `limit` remain. Returns how many went.
std::size_t thin_out(PointCloud& cloud, std::size_t limit);

}  // namespace shape_pipeline
