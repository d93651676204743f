// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu {

/// A connected piece of a closed mesh's surface.
struct MeshShell {
  std::vector<std::size_t> faces;
  double volume = 0;      // signed: positive where its normals point outwards [m3]
  int shells_around = 0;  // how many of the other shells it lies in
};

/// The shells of a closed mesh whose faces do not pass through one another. `neighbours`: of face_neighbours.
std::vector<MeshShell> mesh_shells(const catalog::TriangleMesh& mesh,
                                   const std::vector<std::array<int, 3>>& neighbours);

}  // namespace dem_gpu
