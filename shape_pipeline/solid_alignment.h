// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/rigid_motion.h"

namespace shape_pipeline {

struct SolidAlignment {
  RigidMotion motion;                  // of the moving solid, onto the fixed one
  std::vector<catalog::Check> checks;  // "alignment_distance", "attitude_margin"
};

/// Two whole solids brought together: centroids and principal axes in the 24 attitudes that map axes to axes, each
/// followed by closest points (registration/fine_alignment.h); the one of least mean distance is refined. "Alignment
/// distance" is that mean, over the diagonal; "attitude margin" the next-best attitude's over it.
SolidAlignment align_solids(const catalog::TriangleMesh& moving, const catalog::TriangleMesh& fixed);

/// How one shape lies about another.
struct ShapeDifference {
  std::vector<double> distances;        // of each vertex of the moved shape, positive outside the fixed one [m]
  catalog::SurfaceDistance from_moved;  // points of the moved surface to the fixed one / diagonal of the fixed one
  catalog::SurfaceDistance from_fixed;  // points of the fixed surface to the moved one / the same
  double mean_signed = 0;               // of the moved surface, positive outside [m]
};

/// Of two closed solids in one frame.
ShapeDifference shape_difference(const catalog::TriangleMesh& moved, const catalog::TriangleMesh& fixed);

}  // namespace shape_pipeline
