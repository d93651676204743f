// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Convex hull as a closed triangle mesh with outward normals; empty if the points span no volume.
catalog::TriangleMesh convex_hull(const std::vector<catalog::Point>& points);

}  // namespace shape_pipeline
