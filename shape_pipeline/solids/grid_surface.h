// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Closed, outward surface of the cells (i, j, k) that are full, of a grid with the given planes on each axis
/// (ascending). The caller sees to it that full cells do not meet at an edge or corner alone.
catalog::TriangleMesh grid_surface(const std::array<std::vector<double>, 3>& planes,
                                   const std::function<bool(int, int, int)>& is_full);

}  // namespace shape_pipeline
