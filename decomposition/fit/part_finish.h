// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "decomposition/fit/part_fit.h"

namespace decomposition {

/// Points nearer to a cut plane than this share of the part's size are moved onto it.
inline constexpr double kSnapShare = 0.004;
/// Points of a part nearer to one another than this share of its size are made one.
inline constexpr double kWeldShare = 0.01;

/// The best of several fits of a piece, with close points welded, points near a cut plane drawn to it, and the volume
/// set to plan.volume.
PartFit finish_part(const Solid& solid, const std::vector<Plane>& cell, const RegionMoments& region,
                    const FitPlan& plan, int tries);

}  // namespace decomposition
