// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/triangle_mesh.h"
#include "decomposition/decomposition_quality.h"

namespace decomposition {

/// Shares of the mesh's volume, but for the last.
struct RayVolumes {
  double symmetric_difference = 0, method_error = 0;  // and its standard error over the ray sets
  double missing_volume = 0;
  double overlap = 0;  // sum of the parts' volumes over that of their union, less 1
};

/// Volumes of a mesh and convex parts (closed, outward) by bundles of rays, see ErrorMeasurement, in the mesh's
/// RoundFrame, which changes no share of them: seen from most sides a needle or a plate is too narrow for the rays.
/// `bodies` are those of the mesh, see separate_bodies(); where some lie apart, with parts of their own, each is traced
/// by rays of its own, so that none is small against their distance.
RayVolumes ray_volumes(const catalog::TriangleMesh& mesh, const std::vector<catalog::TriangleMesh>& bodies,
                       const std::vector<catalog::TriangleMesh>& hulls, const QualityOptions& options);

}  // namespace decomposition
