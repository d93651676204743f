// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/fit/partition.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// The corners of every part as the fit sees them: own points, then the corners on its cuts.
std::vector<std::vector<Vec3>> part_points(const Solid& solid, const Partition& partition);

/// V(P) - 2 V(P and solid) over all parts, see ColumnOverlap::misfit; infinite if a part is flat.
double joint_misfit(const Solid& solid, const Partition& partition, int stride = 1);

}  // namespace decomposition
