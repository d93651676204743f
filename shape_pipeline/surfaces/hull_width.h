// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Least distance [m] of two parallel planes that hold a convex hull between them: exact, over all pairs of a face and
/// a vertex and of two edges (Houle & Toussaint 1988).
double least_width(const catalog::TriangleMesh& hull);

}  // namespace shape_pipeline
