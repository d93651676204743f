// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "catalog/shape_record.h"

namespace shape_pipeline {

enum class RemeshingStyle {
  edge_collapse,  // fewer faces where the surface is flat; keeps the volume, never adds faces
  isotropic,      // nearly equilateral faces of one size; finer or coarser
};

struct RemeshingOptions {
  std::size_t face_limit = 10000;  // edge_collapse: at most; isotropic: about
  RemeshingStyle style = RemeshingStyle::edge_collapse;
};

struct RemeshedMesh {
  catalog::TriangleMesh mesh;
  std::vector<catalog::Check> checks;  // "remeshed_faces", "remeshing_volume_change", "remeshing_area_change"; none if
                                       // the mesh was below the limit and is unchanged
};

/// A closed mesh with another number of faces. Where the result would not be closed with the same Euler number, the
/// mesh stays as it was and a failed check says so.
RemeshedMesh remesh(const catalog::TriangleMesh& mesh, const RemeshingOptions& options);

}  // namespace shape_pipeline
