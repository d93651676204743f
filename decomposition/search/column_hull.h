// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/fit/part_fit.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// Corners of the convex hull of the columns' ends, as far as support points tell: in so many spread directions, then
/// for so many rounds along the normals of the hull's faces. `volume` is the hull's with an estimate of what is missing
/// beyond its faces. The same for the same columns, so that near cuts compare without noise. Empty if it is flat.
PartFit column_hull(const std::vector<Stretch>& columns, int directions, int rounds);

}  // namespace decomposition
