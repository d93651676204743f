// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postprocess/run_figures.h"

namespace postprocess {

/// A picture of curves: `name` serves as file name, `svg` is complete.
struct NamedPlot {
  std::string name;
  std::string svg;
};

/// The curves that the run has tables for: discharge, discharge_rate, power, energy, balance, dissipation, wall_power,
/// wall_force, size_distribution.
std::vector<NamedPlot> run_plots(const RunFolder& run, const RunFigures& figures);

}  // namespace postprocess
