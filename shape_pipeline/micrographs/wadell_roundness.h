// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape_pipeline/outline_descriptors.h"

namespace shape_pipeline {

/// Wadell's roundness (1932): mean radius of the circles in the corners over that of the largest inscribed circle R; 1
/// without corners. After Zheng & Hryciw (2015): the outline, at 720 points of equal arc, is smoothed by local
/// quadratic regression (Cleveland 1979) over 1.5 % of the perimeter to either side, three pixels at least; a corner is
/// a stretch more curved than 1/R that turns by more than 0.1 rad beyond the circle of radius R; its circle is fitted
/// to the stretch, which is shortened at both ends until the circle stays inside the outline to 2 % of its radius.
double wadell_roundness(const Outline& outline, double inscribed_radius, double pixel);

}  // namespace shape_pipeline
