// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The union of two solids, each bounded by closed surfaces (cavities turned inwards) that do not cut themselves; none
/// where its surface would be no manifold, such as that of two that share but an edge or a corner.
std::optional<catalog::TriangleMesh> united(const catalog::TriangleMesh& a, const catalog::TriangleMesh& b);

}  // namespace shape_pipeline
