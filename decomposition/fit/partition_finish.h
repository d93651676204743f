// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "decomposition/fit/bounds.h"
#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/part_rules.h"

namespace decomposition {

/// Fits the parts jointly and trims them until all rules hold, then sets the volume to plan.volume. False if a part
/// collapsed.
bool fit_by_rules(const Solid& solid, Partition& partition, const JointPlan& plan, const PartRules& rules);

/// Goes on from a fit until the parts keep the bound, as near to the solid as they can; the rules hold as far as the
/// bound leaves room. The cuts stay. False if a part collapsed or the bound cannot be kept.
bool fit_to_bound(const Solid& solid, Partition& partition, const JointPlan& plan, const PartRules& rules, Bound bound);

}  // namespace decomposition
