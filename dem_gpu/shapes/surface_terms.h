// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "catalog/convex_part.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// Greatest of the depths below a few planes: a lower bound of the distance to one outer polygon, 0 on it.
using GreatestDepth = std::vector<HalfSpace>;

/// One outer polygon of a body's surface.
struct SurfaceTerm {
  std::size_t part = 0;       // whose face it is
  GreatestDepth planes;       // its own plane first
  std::size_t reentrant = 0;  // how many planes at the end are those of neighbours across re-entrant edges
};

/// The canonical depth field of a body is the least of its terms (and of a cap). The planes of a term are
///   its polygon's own, both ways round;
///   the perpendicular plane through each of its edges, and across each of its sharp corners, positive beyond;
///   those of outer polygons that rise from an edge of the same flat face (a re-entrant edge), where this polygon lies
///   wholly in front of them.
/// Each depth has slope 1 and is nowhere positive on the polygon, so a term is at most the distance to its polygon, and
/// at least 1 / sqrt(3) of it. The field is therefore one function over the whole body: zero on its surface, positive
/// inside, continuous, 0.577 to 1 of the Euclidean distance. It does not change where a flat face is cut in two, since
/// each piece's term takes over where the other's edge comes in. Behind a re-entrant edge it is the greater of the two
/// depths, in a convex body the least depth below the faces.
/// `size`: of the body, sets the tolerance for touching edges [m].
std::vector<SurfaceTerm> surface_terms(const std::vector<catalog::ConvexPart>& parts, Real size);

bool is_same_plane(const HalfSpace& a, const HalfSpace& b, Real size);

Real greatest_depth(const GreatestDepth& planes, const Vec3& x);

}  // namespace dem_gpu
