// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/partition_finish.h"

#include <algorithm>

#include "decomposition/fit/joint_misfit.h"

namespace decomposition {
namespace {

constexpr int kRounds = 12;            // of trimming and fitting on
constexpr int kRoundsWithNew = 4;      // of them put what was trimmed elsewhere
constexpr double kMargin = 1.1;        // while the parts still move, edges and faces must be this much larger
constexpr int kMostAtOnce = 4;         // points of a part that are put elsewhere in a round
constexpr double kSpread = 0.3;        // see JointPlan
constexpr double kSpreadMargin = 1.4;  // on the rules, where the spread sets in
constexpr int kBoundRounds = 80;       // of fitting on and pushing towards a bound
constexpr int kBoundRoundsWithNew = 40;
constexpr int kStepsARound = 5, kStepsWithNew = 16;
constexpr int kPushesARound = 3;
constexpr double kBoundFirst = 0.004, kBoundLast = 0.0002;  // share of the diagonal
constexpr double kSlack = 1e-7;                             // share of the diagonal kept beyond a bound
constexpr double kInsideTolerance = 1e-5;                   // share of the diagonal: of edges through the surface
constexpr int kMostPushes = 400;                            // until a bound is kept to the last point
constexpr int kTrimEvery = 4;                               // rounds
constexpr int kLastCycles = 12;                             // of trimming, fitting on and pushing, until both hold
constexpr int kCyclesAtLittleLoss = 3;                      // of them take only what costs little
constexpr double kSpreadGrowth = 0.5, kLossGrowth = 1.5;    // of the spread and of what a flaw may cost, a cycle
constexpr int kLastRoundsFrom = 64, kLastRoundsEvery = 4;   // of the rounds before, repeated in every cycle
constexpr double kPushesToOneMore = 15;                     // before they grow by their first size
constexpr double kLastMargin = 1.02;
constexpr int kLastRounds = 4;  // of trimming and setting the volume

/// Adds own points inside the parts: the fit puts them where they are of use.
void add_dead_points(const Solid& solid, Partition& partition, const std::vector<int>& counts) {
  const std::vector<std::vector<Vec3>> points = part_points(solid, partition);
  for (std::size_t a = 0; a < counts.size(); ++a) {
    Vec3 middle;
    for (const Vec3& p : points[a]) middle += (1.0 / static_cast<double>(points[a].size())) * p;
    for (int k = 0; k < counts[a]; ++k) partition.leaves[a].points.push_back(middle);
  }
}

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
    if (puts_new)
      add_dead_points(solid, partition, lost);
    else
      drop_dead_points(solid, partition);
    if (!fit_jointly(solid, partition, settling)) return false;
  }
  PartRules certain = rules;  // the last triangulation of a face may be another
  certain.shortest_edge *= kLastMargin;
  certain.narrowest_face *= kLastMargin;
  drop_dead_points(solid, partition);
  for (int round = 0; round < kLastRounds; ++round) {
    if (trim(solid, partition, certain, Trim::flaws).empty() || trim(solid, partition, certain, Trim::all).empty())
      return false;
    if (plan.volume <= 0 || round + 1 == kLastRounds) break;
    correct_volume(solid, partition, plan.volume);
  }
  return true;
}

namespace {

/// `points` grows by what is found inside a part between them.
bool push_to_bound(const Solid& solid, Partition& partition, Bound bound, BoundPoints& points) {
  for (int push = 0; push < kMostPushes; ++push) {
    const double breach =
        push_towards_bound(solid, partition, bound, points, 2 * kSlack * solid.diagonal(), 1 + push / kPushesToOneMore);
    if (!std::isfinite(breach)) return false;
    if (breach > -kSlack * solid.diagonal()) continue;
    if (bound == Bound::holds_solid ||
        add_points_inside(solid, partition, kInsideTolerance * solid.diagonal(), points) == 0)
      return true;
  }
  return false;
}

}  // namespace

bool fit_to_bound(const Solid& solid, Partition& partition, const JointPlan& plan, const PartRules& rules,
                  Bound bound) {
  BoundPoints points = bound_points(solid, partition, bound == Bound::holds_solid);
  PartRules stricter = rules;
  stricter.shortest_edge *= kMargin;
  stricter.narrowest_face *= kMargin;
  JointPlan settling = plan;
  settling.cut_rate = 0;
  settling.volume = 0;
  settling.spread = kSpread;
  settling.shortest_edge = kSpreadMargin * rules.shortest_edge;
  settling.narrowest_face = kSpreadMargin * rules.narrowest_face;
  const auto approach = [&](int round) {
    settling.first_step = kBoundFirst * std::pow(kBoundLast / kBoundFirst, round / (kBoundRounds - 1.0));
    settling.last_step = settling.first_step;
    settling.seed = plan.seed + static_cast<std::uint64_t>(round);
    if (!fit_jointly(solid, partition, settling)) return false;
    for (int push = 0; push < kPushesARound; ++push)
      push_towards_bound(solid, partition, bound, points, kSlack * solid.diagonal());
    return true;
  };
  for (int round = 0; round < kBoundRounds; ++round) {
    settling.revives = round < kBoundRoundsWithNew;
    settling.steps = settling.revives ? kStepsWithNew : kStepsARound;
    if (round % kTrimEvery == 0) {
      const std::vector<int> lost = settling.revives ? trim(solid, partition, stricter, Trim::own_points, kMostAtOnce)
                                                     : trim(solid, partition, stricter, Trim::flaws);
      if (lost.empty()) return false;
      drop_dead_points(solid, partition);
      if (settling.revives && rules.faces == 0) {
        std::vector<int> spare;
        for (const std::vector<Vec3>& part : part_points(solid, partition))
          spare.push_back(std::max(0, rules.vertices - static_cast<int>(part.size())));
        add_dead_points(solid, partition, spare);
      }
    }
    if (!approach(round)) return false;
  }
  drop_dead_points(solid, partition);
  for (int cycle = 0; cycle < kLastCycles; ++cycle) {
    if (!push_to_bound(solid, partition, bound, points)) return false;
    if (count_flaws(solid, partition, rules) == 0) return true;
    settling.spread = kSpread * (1 + kSpreadGrowth * cycle);
    if (cycle >= kCyclesAtLittleLoss) stricter.largest_loss *= kLossGrowth;
    if (trim(solid, partition, stricter, Trim::flaws).empty()) return false;
    for (int round = kLastRoundsFrom; round < kBoundRounds; round += kLastRoundsEvery)
      if (!approach(round)) return false;
  }
  return push_to_bound(solid, partition, bound, points);
}

}  // namespace decomposition
