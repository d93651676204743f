// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_report.h"

namespace workflows {

/// What a page tells beside the figures.
struct PageFrame {
  std::vector<std::string> left_out;  // solids that have no file
  std::vector<std::string> cases;     // that could be measured; those without figures are named
  int seeds = 1;
};

/// Tables of what the figures hold, in Markdown that reads on a terminal too.
std::string decomposition_page(const std::vector<ReportedFigure>& figures, const PageFrame& frame);

}  // namespace workflows
