// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
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
/// the standard error of the mean over the ray sets; needles and plates are traced in their RoundFrame. Volume, centre
/// and inertia errors are exact (signed tetrahedra; of parts that overlap the sums), the convexity error is where parts
/// do not overlap (exact hulls). Surfaces: distances from points spread over the mesh to the outer faces, and from
/// points of the faces that no other part covers to the mesh. Means are good to about 1 % of themselves (20,000 points
/// each way); the largest distance is that of a sample point, so the true one may be larger by the distance between
/// points. The mesh must be closed with outward normals.
class ErrorMeasurement {
 public:
  /// Keeps a reference to the mesh, and what of it is the same for all parts.
  explicit ErrorMeasurement(const catalog::TriangleMesh& mesh, const QualityOptions& options = {});
  ~ErrorMeasurement();

  catalog::DecompositionError operator()(const std::vector<catalog::ConvexPart>& parts) const;

 private:
  struct Reference;
  std::unique_ptr<const Reference> reference_;
};

/// The same for one set of parts.
catalog::DecompositionError measure_error(const catalog::TriangleMesh& mesh,
                                          const std::vector<catalog::ConvexPart>& parts,
                                          const QualityOptions& options = {});

}  // namespace decomposition
