// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "decomposition/fit/partition.h"
#include "decomposition/search/cut_tree.h"

namespace decomposition {

/// A partition to start a joint fit from: the tree's cuts and cells for `count` parts; corners of the sections and own
/// points of the parts on the ellipsoids of inertia of the solid there, moved to its surface. About `part_vertices[a]`
/// vertices for leaf a, sections' corners among them.
Partition start_partition(const Solid& solid, const CutTree& tree, int count, int vertices, std::uint64_t seed);

}  // namespace decomposition
