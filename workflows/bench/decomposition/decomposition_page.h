// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_report.h"

namespace workflows {

/// Tables of what the figures hold, in Markdown that reads on a terminal too. `left_out` names the solids that have no
/// file.
std::string decomposition_page(const std::vector<ReportedFigure>& figures, const std::vector<std::string>& left_out,
                               int seeds);

}  // namespace workflows
