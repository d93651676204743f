// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The solid of all points that lie in one of the bodies, each a closed outward surface that does not cut itself; none
/// where its surface would be no manifold (bodies that share but an edge or a corner) or a body is none.
std::optional<catalog::TriangleMesh> united(const std::vector<catalog::TriangleMesh>& bodies);

}  // namespace shape_pipeline
