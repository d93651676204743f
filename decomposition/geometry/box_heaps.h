// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

using Heap = std::vector<std::size_t>;  // numbers of boxes, ascending

/// Boxes that meet, directly or by others, are one heap; heaps come in the order of their first box.
std::vector<Heap> heaps_of(const std::vector<Box>& boxes);

}  // namespace decomposition
