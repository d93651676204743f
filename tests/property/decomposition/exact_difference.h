// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "catalog/convex_part.h"
#include "catalog/triangle_mesh.h"

namespace exact {

struct Volumes {
  double mesh = 0, parts = 0, common = 0;
};

/// Volumes of a solid, of parts that do not overlap, and of what they share, by Booleans on Nef polyhedra in exact
/// arithmetic (Hachenberger & Kettner 2007, CGAL); only the last sums are rounded.
Volumes volumes(const catalog::TriangleMesh& mesh, const std::vector<catalog::ConvexPart>& parts);

}  // namespace exact
