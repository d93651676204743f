// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The closed mesh with at most `face_limit` faces, by collapsing edges in the order of least change; each collapse
/// keeps the volume (Lindstrom & Turk 1998) and the topology.
catalog::TriangleMesh collapsed_to(const catalog::TriangleMesh& mesh, std::size_t face_limit);

}  // namespace shape_pipeline
