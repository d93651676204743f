// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Rows: axes of a bounding box of nearly the smallest volume, by evolution of rotations (Chang, Gorissen & Melchior
/// 2011). Repeatable: the seed is fixed.
catalog::Matrix3 optimal_box_axes(const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
