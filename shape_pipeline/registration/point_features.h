// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// How the surface bends around a point: three histograms of 11 classes.
using PointFeature = std::array<float, 33>;

/// Fast point feature histograms (Rusu, Blodow & Beetz 2009) within the radius [m], one a point of an oriented cloud.
std::vector<PointFeature> point_features(const PointCloud& cloud, double radius);

}  // namespace shape_pipeline
