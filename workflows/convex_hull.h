// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "catalog/convex_part.h"

namespace workflows {

/// Convex hull of a few points [m], with whole polygons for faces: every plane through three of them that has all
/// others on one side. For walls written by hand; n^4 in the number of points.
/// Throws catalog::InputError if they lie in one plane or one of them is no corner of the hull.
catalog::ConvexPart convex_hull(const std::vector<catalog::Point>& points);

}  // namespace workflows
