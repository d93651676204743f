// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "decomposition/convex_decomposition.h"
#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/part_rules.h"
#include "decomposition/search/cut_tree.h"
#include "decomposition/solid/round_frame.h"

namespace decomposition {

/// Where parts are few their fits are cheap, and worth more tries and steps.
inline int times_for_few(int count) {
  constexpr int kFewParts = 8, kMostTimes = 4;
  return std::clamp(kFewParts / count, 1, kMostTimes);
}

/// The search for cuts, all in the round frame: cut trees of several seeds, of which the best go on at certain numbers
/// of parts, and joint fits of all parts from these. What it finds for a number of parts does not depend on what it was
/// asked before.
class TreeRace {
 public:
  TreeRace(const catalog::TriangleMesh& mesh, const RoundFrame& frame, const DecompositionOptions& options);

  /// Parts fitted jointly for comparison.
  struct Start {
    Partition partition;
    double misfit = 0;
    std::size_t tree = 0;
  };

  /// From all trees in the race, best first; none if no tree has so many parts.
  const std::vector<Start>& starts(int count);
  /// A tree when it had so many pieces, or as many as it can have.
  const CutTree& stage(std::size_t tree, int count);
  /// The first tree; of a drawn solid the one whose pieces fit best, and where all leave it in ill-fitting pieces one
  /// that compares hulls, if that does better.
  const CutTree& first_tree(int count);

  const Solid& solid() const { return solid_; }
  const SearchPlan& plan() const { return plan_; }
  JointPlan joint_plan() const;
  PartRules rules() const;
  int threads() const;

 private:
  /// A tree at every number of parts it has had, as grown, and where its cuts were moved then, as moved.
  struct TreeStages {
    std::map<int, CutTree> grown, moved;
    std::map<int, double> misfit;  // where it was moved: of the joint fit then [m3]
  };

  SearchPlan search_plan(std::size_t tree) const;
  const CutTree& grown(std::size_t tree, int count);
  const CutTree& grown(TreeStages& stages, int count, const SearchPlan& plan) const;
  const CutTree& polished(std::size_t tree, int count);
  void move_cuts(TreeStages& stages, int count) const;
  void plant_trees(int count);
  std::vector<std::size_t> racing_trees(int count);
  int overgrown(int count) const;
  std::vector<Start> starts_from(std::size_t tree, int count);

  DecompositionOptions options_;
  Solid solid_, coarse_;
  SearchPlan plan_;
  std::vector<TreeStages> trees_;
  TreeStages tree_of_hulls_;
  std::map<int, std::vector<Start>> starts_;
};

}  // namespace decomposition
