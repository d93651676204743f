// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace decomposition {

/// Throws catalog::InputError unless the mesh bounds a solid: not empty, finite vertices, valid indices, every edge run
/// through as often one way as the other, outward normals, not flat.
void check_closed_solid(const catalog::TriangleMesh& mesh);

}  // namespace decomposition
