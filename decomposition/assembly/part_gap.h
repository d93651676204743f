// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/convex_part.h"

namespace decomposition {

/// Whether a plane parts them with room on both sides, far above rounding: by the separating axis theorem, over face
/// normals and cross products of edges.
bool have_gap(const catalog::ConvexPart& a, const catalog::ConvexPart& b);

}  // namespace decomposition
