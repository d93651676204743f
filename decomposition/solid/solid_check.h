// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace decomposition {

/// Throws catalog::InputError unless the mesh is a closed surface: not empty, finite vertices, valid indices, every
/// edge run through as often one way as the other.
void check_closed_surface(const catalog::TriangleMesh& mesh);

/// Throws catalog::InputError unless a closed surface bounds a solid: outward normals, not flat, hardly any volume
/// enclosed twice or inside out, by rays along z. Returns the share of that in the volume.
double check_solid(const catalog::TriangleMesh& mesh);

}  // namespace decomposition
