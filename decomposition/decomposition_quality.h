// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/shape_record.h"
#include "catalog/triangle_mesh.h"

namespace decomposition {

struct QualityOptions {
  int ray_sets = 4;               // bundles of rays, each in a random direction of its own
  int rays_across = 192;          // rays along the longer side of a bundle's cross-section
  int surface_samples = 20000;    // points on the mesh, and as many on the parts
  std::uint64_t seed = 20240229;  // of directions, ray places and sample points
};

/// Measures parts against the mesh they stand for, with nothing in common with the search that found them.
/// Volumes: rays in several random directions, jittered over the cross-section, exact along each ray; method_error is
/// the standard error of the mean over the ray sets. Surfaces: distances from points spread over the mesh to the outer
/// faces, and from points of the faces that no other part covers to the mesh; surface_mean is the mean of both means,
/// surface_max the larger of both maxima, over the diagonal of the mesh's bounding box.
/// volume_error is exact (signed tetrahedra). The mesh must be closed with outward normals.
catalog::DecompositionError measure_error(const catalog::TriangleMesh& mesh,
                                          const std::vector<catalog::ConvexPart>& parts,
                                          const QualityOptions& options = {});

}  // namespace decomposition
