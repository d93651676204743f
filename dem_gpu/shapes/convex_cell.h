// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "catalog/convex_part.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// Convex polyhedron as the polygons of its faces; none: empty.
using ConvexCell = std::vector<std::vector<Vec3>>;

ConvexCell convex_cell(const catalog::ConvexPart& part);

/// The piece where depth below `plane` (its normal need not be a unit vector) is not negative. Depths within
/// `tolerance` [m] of zero count as zero; a piece no deeper than that is empty.
ConvexCell clipped(const ConvexCell& cell, const HalfSpace& plane, Real tolerance);

/// A point inside: the mean of the faces' corners.
Vec3 inner_point(const ConvexCell& cell);

}  // namespace dem_gpu
