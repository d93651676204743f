// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_plan.h"

namespace workflows {

/// SVG line plot of the curves that name these axes. On logarithmic ones, points without a positive value (an error of
/// exactly zero) are left out; failed runs are listed below the plot.
std::string log_plot_svg(const PlotAxes& axes, const std::vector<PlotCurve>& curves);

}  // namespace workflows
