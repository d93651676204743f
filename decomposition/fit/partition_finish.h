// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/part_rules.h"

namespace decomposition {

/// Fits the parts jointly and trims them until all rules hold, then sets the volume to plan.volume. False if a part
/// collapsed.
bool fit_by_rules(const Solid& solid, Partition& partition, const JointPlan& plan, const PartRules& rules);

}  // namespace decomposition
