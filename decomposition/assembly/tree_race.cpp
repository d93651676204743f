// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/tree_race.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <thread>
#include <utility>

#include "decomposition/fit/joint_misfit.h"
#include "decomposition/fit/partition_start.h"
#include "decomposition/geometry/parallel_for.h"

namespace decomposition {
namespace {

constexpr double kFieldCells = 2e6;     // a rock of 30,000 faces gets cells about as wide as its triangles
constexpr double kSearchCells = 2.5e5;  // for comparing cuts: what fits the caches is looked up faster
// The race, at effort 1: so many trees are grown, the best of them go on beyond kFirstChoice parts (the joint fit's
// misfit there foretells that at twice as many: correlation 0.5 to 0.8 on rocks).
constexpr double kTrees = 8, kTreesGoingOn = 4;
constexpr double kTreesEnclosing = 5;   // their hulls take more time and scatter less
constexpr double kTreesOfFaceted = 3;   // the many facet planes to try make these trees dear, and alike
constexpr double kTreesBeyondMany = 6;  // at more than kManyParts, where the choice at kFirstChoice foretells less ...
constexpr double kTreesOfVeryMany = 3;  // ... but at more than kVeryManyParts trees are dear
constexpr int kFirstChoice = 4, kManyParts = 8, kVeryManyParts = 16;
constexpr double kIllFitting = 0.05;  // error of a drawn solid's pieces / its volume: worth another tree
constexpr double kRoomToMove = 1.3;   // on the smallest volume and thickness: the joint fits move the cuts
constexpr double kDirections = 24, kRefits = 20;
// Merging of cuts: share of the pieces for each doubling of the effort. Of few pieces the last cuts are the least
// useful ones as a rule; of many the gain is a little more than that of as much time for more trees.
constexpr double kOvergrowth = 0.125, kMostOvergrowth = 0.5;
constexpr int kMovingSteps = 150;  // of the joint fits that move a tree's cuts while it grows
constexpr int kTrialSteps = 400;   // of the joint fits that compare trees
constexpr double kTrialFirst = 0.02, kTrialLast = 0.001;
constexpr double kCutRate = 0.5;
constexpr double kBoundWeight = 4;  // of what a bound forbids against what it allows, while the bound is not kept yet

/// A tree's cuts are moved to suit all parts when it has this many: early, where the later cuts hang on them.
bool moves_cuts_at(int count) { return count == 2 || count == 4 || count == 16; }

/// Sum of the pieces' errors.
double misfit_of(const CutTree& tree, int count) {
  double misfit = 0;
  for (const int piece : tree.pieces(count)) misfit += tree.piece(piece).error;
  return misfit;
}

}  // namespace

TreeRace::TreeRace(const catalog::TriangleMesh& mesh, const RoundFrame& frame, const DecompositionOptions& options)
    : options_(options),
      solid_(frame.is_identity() ? Solid(mesh, kFieldCells) : Solid(frame.to_round(mesh), kFieldCells)),
      coarse_(solid_, kSearchCells) {
  plan_.directions = std::max(4, static_cast<int>(std::lround(kDirections * std::fmin(1.0, options.effort))));
  plan_.refits = std::max(2, static_cast<int>(std::lround(kRefits * std::fmin(1.0, options.effort))));
  plan_.polishing_rounds = 0;  // the joint fits move the cuts
  plan_.encloses = options.mode == FitMode::enclosing;
  plan_.vertex_cap = options.vertex_cap;
  plan_.face_cap = options.face_cap;
  plan_.smallest_volume = options.smallest_volume * solid_.volume();
  plan_.smallest_thickness = options.smallest_thickness * smallest_extent(solid_.vertices(), RoundFrame());
}

int TreeRace::threads() const {
  return options_.threads > 0 ? options_.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

SearchPlan TreeRace::search_plan(std::size_t tree) const {
  SearchPlan plan = plan_;
  plan.seed = sub_seed(options_.seed, 2000003ull + tree);
  plan.smallest_volume *= kRoomToMove;
  plan.smallest_thickness *= kRoomToMove;
  plan.threads = trees_.size() > 1 ? 1 : threads();  // else the trees grow side by side
  return plan;
}

JointPlan TreeRace::joint_plan() const {
  JointPlan plan;
  plan.steps = kTrialSteps;
  plan.first_step = kTrialFirst;
  plan.last_step = kTrialLast;
  plan.cut_rate = kCutRate;
  plan.smallest_part = plan_.smallest_volume;
  if (options_.mode == FitMode::volume_true) plan.volume = solid_.volume();
  if (options_.mode == FitMode::enclosing) plan.rock_weight = kBoundWeight, plan.cut_rate = 0;
  if (options_.mode == FitMode::inscribed) plan.rock_weight = 1 / kBoundWeight;
  plan.seed = options_.seed;
  return plan;
}

PartRules TreeRace::rules() const {
  PartRules rules;
  rules.vertices = options_.vertex_cap;
  rules.faces = options_.face_cap;
  return rules;
}

/// Puts the cuts of a tree where they suit all its parts, as a short joint fit finds.
void TreeRace::move_cuts(TreeStages& stages, int count) const {
  CutTree tree = stages.grown.at(count);
  const std::vector<int> pieces = tree.pieces(count);
  double misfit = misfit_of(tree, count);
  // Cuts of a drawn solid stay on its facets.
  if (plan_.encloses && !solid_.is_faceted()) {
    tree.polish_hulls();
    misfit = misfit_of(tree, count);
  } else if (static_cast<int>(pieces.size()) == count && !solid_.is_faceted()) {
    Partition partition = start_partition(coarse_, tree, count, options_.vertex_cap, options_.seed);
    JointPlan plan = joint_plan();
    plan.steps = kMovingSteps;
    if (fit_jointly(coarse_, partition, plan)) {
      std::vector<Plane> planes;
      for (const Cut& cut : partition.cuts) planes.push_back(cut.plane);
      tree.move_cuts(planes);
      misfit = solid_.volume() + joint_misfit(coarse_, partition);
    }
  }
  stages.misfit[count] = misfit;
  stages.moved.emplace(count, std::move(tree));
}

const CutTree& TreeRace::grown(std::size_t tree, int count) { return grown(trees_[tree], count, search_plan(tree)); }

const CutTree& TreeRace::grown(TreeStages& stages, int count, const SearchPlan& plan) const {
  if (stages.grown.empty()) stages.grown.emplace(1, CutTree(coarse_, plan));
  for (int next = stages.grown.rbegin()->first + 1; next <= count; ++next) {
    if (moves_cuts_at(next - 1) && !stages.moved.contains(next - 1)) move_cuts(stages, next - 1);
    CutTree larger = (moves_cuts_at(next - 1) ? stages.moved : stages.grown).at(next - 1);
    larger.grow(next);
    stages.grown.emplace(next, std::move(larger));
  }
  return stages.grown.at(count);
}

/// The tree from which parts are fitted: as grown, the joint fits move the cuts; cuts of enclosing parts stand still.
const CutTree& TreeRace::polished(std::size_t tree, int count) {
  const CutTree& plain = grown(tree, count);
  if (!plan_.encloses || static_cast<int>(plain.pieces(count).size()) < count) return plain;
  TreeStages& stages = trees_[tree];
  if (!stages.moved.contains(count)) move_cuts(stages, count);
  return stages.moved.at(count);
}

/// As many trees as the effort asks for, grown to `count` parts or to where the best are chosen.
void TreeRace::plant_trees(int count) {
  const int grown_to = std::min(count, kFirstChoice);
  const double trees =
      (solid_.is_faceted() ? kTreesOfFaceted : (plan_.encloses ? kTreesEnclosing : kTrees)) * options_.effort;
  trees_.resize(static_cast<std::size_t>(std::max(1.0, std::round(trees))));
  parallel_for(static_cast<int>(trees_.size()), threads(),
               [&](int t) { grown(static_cast<std::size_t>(t), grown_to); });
}

/// The trees that are still in the race at this number of parts.
std::vector<std::size_t> TreeRace::racing_trees(int count) {
  if (trees_.empty()) plant_trees(count);
  std::vector<std::size_t> racing;
  for (std::size_t t = 0; t < trees_.size(); ++t) racing.push_back(t);
  if (count <= kFirstChoice) return racing;
  parallel_for(static_cast<int>(trees_.size()), threads(), [&](int t) {
    const auto tree = static_cast<std::size_t>(t);
    grown(tree, kFirstChoice);
    if (!trees_[tree].moved.contains(kFirstChoice)) move_cuts(trees_[tree], kFirstChoice);
  });
  std::stable_sort(racing.begin(), racing.end(), [&](std::size_t a, std::size_t b) {
    return trees_[a].misfit.at(kFirstChoice) < trees_[b].misfit.at(kFirstChoice);
  });
  const double trees =
      count > kVeryManyParts ? kTreesOfVeryMany : (count > kManyParts ? kTreesBeyondMany : kTreesGoingOn);
  const double going_on = trees * std::sqrt(options_.effort);
  racing.resize(std::min(racing.size(), static_cast<std::size_t>(std::max(1.0, std::round(going_on)))));
  return racing;
}

const CutTree& TreeRace::stage(std::size_t tree, int count) {
  if (trees_.empty()) plant_trees(count);
  return grown(tree, count);
}

const CutTree& TreeRace::first_tree(int count) {
  const CutTree* best = &stage(0, count);
  if (!solid_.is_faceted() || plan_.encloses) return *best;
  double misfit = misfit_of(*best, count);
  for (std::size_t tree = 1; tree < trees_.size() && misfit > 0; ++tree)
    if (const CutTree& next = stage(tree, count); misfit_of(next, count) < misfit) {
      best = &next;
      misfit = misfit_of(next, count);
    }
  if (misfit < kIllFitting * solid_.volume()) return *best;
  SearchPlan plan = search_plan(0);
  plan.compares_hulls = true;
  const CutTree& other = grown(tree_of_hulls_, count, plan);
  return misfit_of(other, count) < misfit ? other : *best;
}

/// Pieces that a tree gets before its least useful cuts are merged away again: more than asked for where effort allows.
int TreeRace::overgrown(int count) const {
  if (count <= kManyParts || plan_.encloses || solid_.is_faceted()) return count;
  const double share = std::clamp(kOvergrowth * std::log2(options_.effort), 0.0, kMostOvergrowth);
  return count + static_cast<int>(share * count);
}

std::vector<TreeRace::Start> TreeRace::starts_from(std::size_t tree, int count) {
  std::vector<Start> result;
  const CutTree& from = polished(tree, count);
  if (static_cast<int>(from.pieces(count).size()) < count) return result;  // the tree has no more
  std::optional<CutTree> merged;
  if (const int grown_to = overgrown(count); grown_to > count) {
    merged.emplace(grown(tree, grown_to));
    merged->merge_down(count);
  }
  for (int variant = 0; variant < times_for_few(count); ++variant) {
    Start start;
    start.tree = tree;
    JointPlan plan = joint_plan();
    plan.seed = sub_seed(options_.seed, 100 * tree + static_cast<std::uint64_t>(variant));
    start.partition = start_partition(solid_, merged ? *merged : from, count, options_.vertex_cap, plan.seed);
    if (trim(solid_, start.partition, rules(), Trim::caps).empty()) continue;
    if (!fit_jointly(solid_, start.partition, plan)) continue;
    start.misfit = joint_misfit(solid_, start.partition);
    result.push_back(std::move(start));
  }
  return result;
}

const std::vector<TreeRace::Start>& TreeRace::starts(int count) {
  if (const auto known = starts_.find(count); known != starts_.end()) return known->second;
  const std::vector<std::size_t> racing = racing_trees(count);
  std::vector<std::vector<Start>> from(racing.size());
  parallel_for(static_cast<int>(racing.size()), threads(), [&](int k) {
    const auto r = static_cast<std::size_t>(k);
    from[r] = starts_from(racing[r], count);
  });
  std::vector<Start> result;
  for (std::vector<Start>& some : from) std::move(some.begin(), some.end(), std::back_inserter(result));
  std::stable_sort(result.begin(), result.end(), [](const Start& a, const Start& b) { return a.misfit < b.misfit; });
  return starts_[count] = std::move(result);
}

}  // namespace decomposition
