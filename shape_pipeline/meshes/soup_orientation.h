// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Turns neighbouring faces the same way round, and splits vertices and edges where more than two faces or fans meet,
/// so that what remains is an oriented manifold with borders; borders that coincide are stitched.
catalog::TriangleMesh oriented_manifold(const catalog::TriangleMesh& soup);

}  // namespace shape_pipeline
