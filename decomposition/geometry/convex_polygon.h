// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "decomposition/geometry/vector3.h"

namespace decomposition {

using Point2 = std::array<double, 2>;
using Polygon2 = std::vector<Point2>;  // convex, counter-clockwise

double area(const Polygon2& polygon);

/// The part of `subject` inside the convex polygon `clip` (Sutherland & Hodgman 1974); may be empty.
Polygon2 intersection(Polygon2 subject, const Polygon2& clip);

/// Corners of the convex hull, counter-clockwise; a point must stand out by more than `tolerance` to be a corner.
std::vector<int> convex_hull(const std::vector<Point2>& points, double tolerance);

/// The part of a planar polygon in space behind every plane; may be empty.
std::vector<Vec3> clip(std::vector<Vec3> polygon, const std::vector<Plane>& planes);

}  // namespace decomposition
