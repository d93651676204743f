// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// The cloud with unit normals by principal component analysis of `neighbours` points, oriented alike along a minimum
/// spanning tree (Hoppe et al. 1992); points whose orientation stays open are dropped. The common sign is not settled.
PointCloud with_estimated_normals(const PointCloud& cloud, int neighbours);

}  // namespace shape_pipeline
