// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/partition_finish.h"

#include <algorithm>

namespace decomposition {
namespace {

constexpr int kRounds = 12;            // of trimming and fitting on
constexpr int kRoundsWithNew = 4;      // of them put what was trimmed elsewhere
constexpr double kMargin = 1.1;        // while the parts still move, edges and faces must be this much larger
constexpr int kMostAtOnce = 4;         // points of a part that are put elsewhere in a round
constexpr double kSpread = 0.3;        // see JointPlan
constexpr double kSpreadMargin = 1.4;  // on the rules, where the spread sets in
constexpr int kLastRounds = 4;         // of trimming and setting the volume

}  // namespace

bool fit_by_rules(const Solid& solid, Partition& partition, const JointPlan& plan, const PartRules& rules) {
  if (trim(solid, partition, rules, Trim::caps).empty()) return false;
  PartRules stricter = rules;
  stricter.shortest_edge *= kMargin;
  stricter.narrowest_face *= kMargin;
  JointPlan settling = plan;
  settling.steps = plan.steps / kRounds;
  settling.spread = kSpread;
  settling.shortest_edge = kSpreadMargin * rules.shortest_edge;
  settling.narrowest_face = kSpreadMargin * rules.narrowest_face;
  const double decay = std::pow(plan.last_step / plan.first_step, 1.0 / kRounds);
  settling.last_step = plan.first_step;
  for (int round = 0; round < kRounds; ++round) {
    const bool puts_new = round < kRoundsWithNew;
    settling.first_step = settling.last_step;
    settling.last_step = settling.first_step * decay;
    const std::vector<int> lost = puts_new ? trim(solid, partition, stricter, Trim::own_points, kMostAtOnce)
                                           : trim(solid, partition, stricter, Trim::flaws);
    if (lost.empty()) return false;
    settling.revives = puts_new;
    settling.seed = plan.seed + static_cast<std::uint64_t>(round) + 1;
    if (puts_new) {
      const std::vector<std::vector<Vec3>> points = part_points(solid, partition);
      for (std::size_t a = 0; a < lost.size(); ++a) {
        Vec3 middle;
        for (const Vec3& p : points[a]) middle += (1.0 / static_cast<double>(points[a].size())) * p;
        // The fit puts points that lie inside where rock stands out.
        for (int k = 0; k < lost[a]; ++k) partition.leaves[a].points.push_back(middle);
      }
    } else {
      drop_dead_points(solid, partition);
    }
    if (!fit_jointly(solid, partition, settling)) return false;
  }
  drop_dead_points(solid, partition);
  for (int round = 0; round < kLastRounds; ++round) {
    if (trim(solid, partition, rules, Trim::flaws).empty() || trim(solid, partition, rules, Trim::all).empty())
      return false;
    if (plan.volume <= 0 || round + 1 == kLastRounds) break;
    correct_volume(solid, partition, plan.volume);
  }
  return true;
}

}  // namespace decomposition
