// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "catalog/triangle_mesh.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// The closed surface that bodies touch: the mesh itself, its shells turned so for a container; an open sheet with its
/// back and rim. The solid lies behind the triangles. Throws catalog::InputError, without the wall's name, for a mesh
/// that is open without a thickness, with an inverted shell, wound in two ways, degenerate, not a manifold, or that
/// cuts itself.
catalog::TriangleMesh contact_surface(const MeshObject& object);

}  // namespace dem_gpu
