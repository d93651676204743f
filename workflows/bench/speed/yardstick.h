// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace workflows {

/// What LIGGGHTS takes on this machine just now for a step of the settled box S1, one process [CPU ms]; nothing where
/// it is not installed or the peers' scripts are not there (tests/benchmark/peers). Settles S1 the first time.
std::optional<double> liggghts_step_time();

/// LIGGGHTS's time at which the bounds of the scenes were set [ms].
inline constexpr double kReferenceStepTime = 2.9;

}  // namespace workflows
