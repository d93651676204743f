// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "workflows/fill.h"
#include "workflows/random_stream.h"

namespace workflows {

/// Centres of balls set one on another: each in turn takes the lowest of a few random columns' lowest free places along
/// the unit vector `up`. Balls do not overlap and lie inside the region. Fewer centres than radii where it is full.
std::vector<Point> dense_packing(const FillRegion& region, const std::vector<double>& radii, const Point& up,
                                 RandomStream& random);

}  // namespace workflows
