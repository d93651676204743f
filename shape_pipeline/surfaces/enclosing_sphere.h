// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Radius [m] of the smallest sphere that holds all the points.
double enclosing_radius(const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
