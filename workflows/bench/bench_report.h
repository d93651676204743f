// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workflows/bench/bench_plan.h"

namespace workflows {

/// "<= 0.05"; empty without a goal.
std::string goal_text(const Figure& figure);

/// nullopt without a goal; a failed run does not meet one.
std::optional<bool> is_goal_met(const Figure& figure);

/// One JSON object a line: bench, case, figure, value, unit, goal, met, command. `value` is null for a failed run.
std::string json_lines(const std::vector<ReportedFigure>& figures);

/// Columns aligned for a terminal.
std::string text_table(const std::vector<ReportedFigure>& figures);

std::string markdown_table(const std::string& title, const std::vector<ReportedFigure>& figures);

}  // namespace workflows
