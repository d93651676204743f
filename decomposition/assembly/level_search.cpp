// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/level_search.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <thread>
#include <utility>

#include "decomposition/assembly/face_kinds.h"
#include "decomposition/fit/part_finish.h"
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
constexpr double kTreesOfFaceted = 2;   // the many facet planes to try make these trees dear, and alike
constexpr double kTreesBeyondMany = 6;  // at more than kManyParts, where the choice at kFirstChoice foretells less ...
constexpr double kTreesOfVeryMany = 3;  // ... but at more than kVeryManyParts trees are dear
constexpr int kFirstChoice = 4, kManyParts = 8, kVeryManyParts = 16;
constexpr double kShareForTrees = 0.5;  // of a time budget
constexpr std::size_t kMostTrees = 1000;
constexpr double kRoomToMove = 1.3;  // on the smallest volume and thickness: the joint fits move the cuts
constexpr double kDirections = 24, kRefits = 20;
constexpr int kFewParts = 8, kMostTimes = 4;
constexpr int kMovingSteps = 150;  // of the joint fits that move a tree's cuts while it grows
constexpr int kTrialSteps = 400;   // of the joint fits that compare trees
constexpr double kTrialFirst = 0.02, kTrialLast = 0.001;
constexpr double kFinals = 2, kFinalsEnclosing = 3;  // of the best starts are finished, at effort 1
constexpr int kFinalSteps = 1200;
constexpr double kFinalFirst = 0.01, kFinalLast = 0.0007;  // share of the diagonal
constexpr double kCutRate = 0.5;
constexpr double kLargeLedge = 0.2;   // share of a face's area: splitting makes new small faces
constexpr double kBetterApart = 1.1;  // joint error over that of single pieces
constexpr double kBoundWeight = 4;    // of what a bound forbids against what it allows, while the bound is not kept yet
constexpr int kFitSteps = 500;        // of parts fitted alone, beside exact pieces
constexpr double kFitTries = 3;       // at effort 1
constexpr int kVolumeRounds = 4;      // of fitting them anew until the union has the solid's volume ...
constexpr double kVolumeAgreement = 2e-4;                 // ... to this share
constexpr double kLeastFactor = 0.8, kMostFactor = 1.25;  // of the volume asked of parts fitted alone
constexpr double kExactSnap = 1e-9;                       // of the size: fitted points touch their cut planes already

Vec3 middle_of(const std::vector<std::vector<Vec3>>& parts) {
  Vec3 sum;
  std::size_t count = 0;
  for (const std::vector<Vec3>& points : parts)
    for (const Vec3& p : points) sum += p, ++count;
  return (1.0 / static_cast<double>(count)) * sum;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Where parts are few their fits are cheap, and worth more tries and steps.
int times_for_few(int count) { return std::clamp(kFewParts / count, 1, kMostTimes); }

/// A tree's cuts are moved to suit all parts when it has this many: early, where the later cuts hang on them.
bool moves_cuts_at(int count) { return count == 2 || count == 4 || count == 16; }

}  // namespace

LevelSearch::LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options)
    : options_(options), solid_(mesh, kFieldCells), coarse_(solid_, kSearchCells), started_(cpu_seconds()) {
  columns_volume_ = solid_.volume_inside({});
  plan_.directions = std::max(4, static_cast<int>(std::lround(kDirections * std::fmin(1.0, options.effort))));
  plan_.refits = std::max(2, static_cast<int>(std::lround(kRefits * std::fmin(1.0, options.effort))));
  plan_.polishing_rounds = 0;  // the joint fits move the cuts
  plan_.encloses = options.mode == FitMode::enclosing;
  plan_.vertex_cap = options.vertex_cap;
  plan_.face_cap = options.face_cap;
  plan_.smallest_volume = options.smallest_volume * solid_.volume();
  plan_.smallest_thickness = options.smallest_thickness * thickness_of_whole();
}

int LevelSearch::threads() const {
  return options_.threads > 0 ? options_.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Smallest extent of the mesh over spread directions and the box's axes.
double LevelSearch::thickness_of_whole() const {
  double thickness = std::numeric_limits<double>::infinity();
  constexpr int kSpread = 200;
  for (int d = 0; d < kSpread + 3; ++d) {
    const Vec3 axis{d == kSpread ? 1.0 : 0.0, d == kSpread + 1 ? 1.0 : 0.0, d == kSpread + 2 ? 1.0 : 0.0};
    const Vec3 direction = d < kSpread ? spread_direction(d, 2 * kSpread) : axis;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : solid_.vertices()) {
      low = std::fmin(low, dot(direction, p));
      high = std::fmax(high, dot(direction, p));
    }
    thickness = std::fmin(thickness, high - low);
  }
  return thickness;
}

SearchPlan LevelSearch::search_plan(std::size_t tree) const {
  SearchPlan plan = plan_;
  plan.seed = sub_seed(options_.seed, 2000003ull + tree);
  plan.smallest_volume *= kRoomToMove;
  plan.smallest_thickness *= kRoomToMove;
  plan.threads = trees_.size() > 1 ? 1 : threads();  // else the trees grow side by side
  return plan;
}

JointPlan LevelSearch::joint_plan() const {
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

PartRules LevelSearch::rules() const {
  PartRules rules;
  rules.vertices = options_.vertex_cap;
  rules.faces = options_.face_cap;
  return rules;
}

/// Puts the cuts of a tree where they suit all its parts, as a short joint fit finds.
void LevelSearch::move_cuts(TreeStages& stages, int count) const {
  CutTree tree = stages.grown.at(count);
  const std::vector<int> pieces = tree.pieces(count);
  double misfit = 0;
  for (const int piece : pieces) misfit += tree.piece(piece).error;
  // Cuts of a drawn solid stay on its facets.
  if (plan_.encloses && !solid_.is_faceted()) {
    tree.polish_hulls();
    misfit = 0;
    for (const int piece : tree.pieces(count)) misfit += tree.piece(piece).error;
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

const CutTree& LevelSearch::stage(std::size_t tree, int count) {
  TreeStages& stages = trees_[tree];
  if (stages.grown.empty()) stages.grown.emplace(1, CutTree(coarse_, search_plan(tree)));
  for (int next = stages.grown.rbegin()->first + 1; next <= count; ++next) {
    if (moves_cuts_at(next - 1) && !stages.moved.contains(next - 1)) move_cuts(stages, next - 1);
    CutTree grown = (moves_cuts_at(next - 1) ? stages.moved : stages.grown).at(next - 1);
    grown.grow(next);
    stages.grown.emplace(next, std::move(grown));
  }
  return stages.grown.at(count);
}

/// The tree from which parts are fitted: as grown, the joint fits move the cuts; cuts of enclosing parts stand still.
const CutTree& LevelSearch::polished(std::size_t tree, int count) {
  const CutTree& grown = stage(tree, count);
  if (!plan_.encloses || static_cast<int>(grown.pieces(count).size()) < count) return grown;
  TreeStages& stages = trees_[tree];
  if (!stages.moved.contains(count)) move_cuts(stages, count);
  return stages.moved.at(count);
}

/// As many trees as the effort or the time asks for, grown to `count` parts or to where the best are chosen.
void LevelSearch::plant_trees(int count) {
  const int grown_to = std::min(count, kFirstChoice);
  if (options_.time_budget > 0) {
    const double begin = cpu_seconds();
    while (trees_.empty() || cpu_seconds() - started_ + (cpu_seconds() - begin) / static_cast<double>(trees_.size()) <
                                 kShareForTrees * options_.time_budget) {
      trees_.emplace_back();
      stage(trees_.size() - 1, grown_to);
      if (trees_.size() == kMostTrees) break;
    }
    return;
  }
  const double trees =
      (solid_.is_faceted() ? kTreesOfFaceted : (plan_.encloses ? kTreesEnclosing : kTrees)) * options_.effort;
  trees_.resize(static_cast<std::size_t>(std::max(1.0, std::round(trees))));
  parallel_for(static_cast<int>(trees_.size()), threads(),
               [&](int t) { stage(static_cast<std::size_t>(t), grown_to); });
}

/// The trees that are still in the race at this number of parts.
std::vector<std::size_t> LevelSearch::racing_trees(int count) {
  if (trees_.empty()) plant_trees(count);
  std::vector<std::size_t> racing;
  for (std::size_t t = 0; t < trees_.size(); ++t) racing.push_back(t);
  if (count <= kFirstChoice) return racing;
  parallel_for(static_cast<int>(trees_.size()), threads(), [&](int t) {
    const auto tree = static_cast<std::size_t>(t);
    stage(tree, kFirstChoice);
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

std::vector<LevelSearch::Start> LevelSearch::starts_from(std::size_t tree, int count) {
  std::vector<Start> result;
  for (int variant = 0; variant < times_for_few(count); ++variant) {
    Start start;
    start.tree = tree;
    JointPlan plan = joint_plan();
    plan.seed = sub_seed(options_.seed, 100 * tree + static_cast<std::uint64_t>(variant));
    start.partition = start_partition(solid_, polished(tree, count), count, options_.vertex_cap, plan.seed);
    if (static_cast<int>(start.partition.leaves.size()) < count) continue;  // the tree has no more
    if (trim(solid_, start.partition, rules(), Trim::caps).empty()) continue;
    if (!fit_jointly(solid_, start.partition, plan)) continue;
    start.misfit = joint_misfit(solid_, start.partition);
    result.push_back(std::move(start));
  }
  return result;
}

const std::vector<LevelSearch::Start>& LevelSearch::starts(int count) {
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

LevelSearch::Finish LevelSearch::finished(Partition partition) const {
  JointPlan plan = joint_plan();
  plan.steps = kFinalSteps * times_for_few(static_cast<int>(partition.leaves.size()));
  plan.first_step = kFinalFirst;
  plan.last_step = kFinalLast;
  if (!fit_by_rules(solid_, partition, plan, rules())) return {};
  if (options_.mode != FitMode::volume_true) {
    plan.rock_weight = 1;
    const Bound bound = options_.mode == FitMode::enclosing ? Bound::holds_solid : Bound::stays_inside;
    if (!fit_to_bound(solid_, partition, plan, rules(), bound)) return {};
  }
  Finish finish;
  finish.misfit = joint_misfit(solid_, partition);
  const Vec3 centre = middle_of(part_points(solid_, partition));
  // What the rules take while the parts are built, and what own points could not make up for, comes back by scaling.
  for (int round = 0; round < kVolumeRounds; ++round) {
    finish.parts = built(partition);
    if (finish.parts.empty() || options_.mode != FitMode::volume_true) break;
    double volume = 0;
    for (const BuiltPart& part : finish.parts) volume += figures({part.part}).smallest_volume;
    const double ratio = solid_.volume() / volume;
    if (std::abs(ratio - 1) < kVolumeAgreement) break;
    scale_volume(partition, centre, ratio);
  }
  finish.keeps_rules = std::all_of(finish.parts.begin(), finish.parts.end(), [&](const BuiltPart& part) {
    const LevelFigures figure = figures({part.part});
    return figure.shortest_edge >= rules().shortest_edge && figure.narrowest_face >= rules().narrowest_face;
  });
  return finish;
}

std::vector<BuiltPart> LevelSearch::built(const Partition& partition) const {
  const std::vector<std::vector<Vec3>> points = part_points(solid_, partition);
  std::vector<BuiltPart> parts;
  for (std::size_t a = 0; a < points.size(); ++a) {
    Cell cell;
    cell.planes = partition.planes_of(partition.leaves[a].sides);
    for (const CutSide& side : partition.leaves[a].sides) cell.cuts.push_back(side.cut);
    const double snap = kExactSnap * solid_.diagonal();
    // The parts keep to the rules by now, but for rounding: the last triangulation of a face may be another.
    std::optional<BuiltPart> part = options_.mode == FitMode::enclosing
                                        ? build_part(points[a], cell, snap)
                                        : build_part_by_rules(points[a], cell, snap, rules());
    if (!part) return {};
    parts.push_back(std::move(*part));
  }
  return parts;
}

FoundLevel LevelSearch::found_jointly(int count) {
  const std::vector<Start>& all = starts(count);
  const auto at_once = static_cast<std::size_t>(
      std::max(1.0, std::round((plan_.encloses ? kFinalsEnclosing : kFinals) * std::sqrt(options_.effort))));
  Finish best;
  for (std::size_t first = 0; first < all.size(); first += at_once) {
    std::vector<Finish> finishes(std::min(at_once, all.size() - first));
    parallel_for(static_cast<int>(finishes.size()), threads(), [&](int k) {
      const auto f = static_cast<std::size_t>(k);
      finishes[f] = finished(all[first + f].partition);
      if (!is_acceptable(finishes[f].parts)) finishes[f].parts.clear();
    });
    for (Finish& finish : finishes) {
      if (finish.parts.empty()) continue;
      const bool is_better = best.parts.empty() || (finish.keeps_rules && !best.keeps_rules) ||
                             (finish.keeps_rules == best.keeps_rules && finish.misfit < best.misfit);
      if (is_better) best = std::move(finish);
    }
    if (best.keeps_rules) break;
  }
  return {std::move(best.parts), 0};
}

bool LevelSearch::is_acceptable(const std::vector<BuiltPart>& parts) const {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [&](const BuiltPart& part) {
    const LevelFigures figure = figures({part.part});
    return figure.smallest_thickness >= plan_.smallest_thickness && figure.smallest_volume >= plan_.smallest_volume &&
           figure.vertices <= options_.vertex_cap && (options_.face_cap == 0 || figure.faces <= options_.face_cap);
  });
}

std::optional<BuiltPart> LevelSearch::fitted_alone(const Piece& piece, int number, double volume_factor) const {
  if (piece.is_exact) return build_part(piece.fit.points, piece.cell, kExactSnap * solid_.diagonal());
  FitPlan plan;
  plan.vertices = options_.vertex_cap;
  // A hull of V points has at most 2 V - 4 faces: with fewer points none need go for the faces' sake.
  if (options_.face_cap > 0) plan.vertices = std::min(plan.vertices, options_.face_cap / 2 + 2);
  plan.steps = kFitSteps;
  plan.volume = volume_factor * piece.region.volume * solid_.volume() /
                columns_volume_;  // the targets add up to the mesh's volume
  plan.seed = sub_seed(options_.seed, 1000003ull + static_cast<std::uint64_t>(number));
  const int tries = std::max(1, static_cast<int>(std::lround(kFitTries * options_.effort)));
  const PartFit fit = finish_part(solid_, piece.cell.planes, piece.region, plan, tries);
  if (!fit.is_valid()) return std::nullopt;
  const double snap = kSnapShare * bounding_box(fit.points).diagonal();
  return build_part_by_rules(fit.points, piece.cell, snap, rules());
}

/// Exact pieces stay as they are. Sections of shells and the like are no convex polygons, which parts fitted jointly
/// have to share: where they fit worse than short fits of single pieces do, they go apart.
bool LevelSearch::fits_better_apart(const CutTree& tree, int count) {
  double apart = 0;
  int exact = 0;
  for (const int piece : tree.pieces(count)) {
    exact += tree.piece(piece).is_exact;
    apart += tree.piece(piece).error;
  }
  // A piece fitted alone is volume-true; only exact ones keep a bound as well.
  if (exact > 0) return options_.mode == FitMode::volume_true || exact == count;
  return options_.mode == FitMode::volume_true && !starts(count).empty() &&
         solid_.volume() + starts(count).front().misfit > kBetterApart * apart;
}

/// The parts of all pieces, fitted alone; none if one cannot be.
std::vector<BuiltPart> LevelSearch::all_alone(const CutTree& tree, const std::vector<int>& pieces,
                                              double volume_factor) const {
  std::vector<std::optional<BuiltPart>> made(pieces.size());
  parallel_for(static_cast<int>(pieces.size()), threads(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    made[k] = fitted_alone(tree.piece(pieces[k]), pieces[k], volume_factor);
  });
  std::vector<BuiltPart> parts;
  for (std::optional<BuiltPart>& part : made) {
    if (!part) return {};
    parts.push_back(std::move(*part));
  }
  return parts;
}

FoundLevel LevelSearch::found_apart(const CutTree& tree, int count) const {
  const std::vector<int> pieces = tree.pieces(count);
  FoundLevel level;
  double factor = 1, least = std::numeric_limits<double>::infinity();
  // Walls and rules keep some pieces from their volume: the others make up for it, as far as they can.
  for (int round = 0; round < kVolumeRounds; ++round) {
    std::vector<BuiltPart> parts = all_alone(tree, pieces, factor);
    if (parts.empty()) break;
    double fitted_volume = 0, lack = solid_.volume();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double volume = figures({parts[k].part}).smallest_volume;
      if (!tree.piece(pieces[k]).is_exact) fitted_volume += volume;
      lack -= volume;
    }
    if (std::abs(lack) < least && is_acceptable(parts)) {
      least = std::abs(lack);
      level.parts = std::move(parts);
    }
    if (fitted_volume == 0 || std::abs(lack) < kVolumeAgreement * solid_.volume()) break;
    factor = std::clamp(factor * (1 + lack / fitted_volume), kLeastFactor, kMostFactor);
  }
  return level;
}

FoundLevel LevelSearch::find(int parts_asked) {
  if (trees_.empty()) plant_trees(parts_asked);
  for (int count = parts_asked; count > 0; --count) {
    FoundLevel level;
    bool is_apart = false;
    // All trees find the exact pieces of a drawn solid, if it has any.
    const std::size_t tree = solid_.is_faceted() || starts(count).empty() ? 0 : starts(count).front().tree;
    const CutTree& cut = stage(tree, count);
    if (static_cast<int>(cut.pieces(count).size()) < count) continue;  // the tree has no more
    is_apart = fits_better_apart(cut, count);
    if (is_apart) level = found_apart(cut, count);
    if (!is_apart) level = found_jointly(count);
    if (level.parts.empty()) continue;
    std::vector<Plane> cuts;
    int cut_count = 0;
    for (const BuiltPart& part : level.parts)
      for (const int cut : part.cell.cuts) cut_count = std::max(cut_count, cut + 1);
    cuts.resize(static_cast<std::size_t>(cut_count));
    for (const BuiltPart& part : level.parts)
      for (std::size_t k = 0; k < part.cell.cuts.size(); ++k)
        cuts[static_cast<std::size_t>(part.cell.cuts[k])] = part.cell.planes[k];
    SplitLimits limits{options_.vertex_cap};
    if (options_.face_cap > 0) limits.faces = options_.face_cap;
    // Parts fitted jointly share their outlines on the cuts, but for corners that the rules have cost some.
    if (!is_apart) limits.smallest_ledge = kLargeLedge;
    const CutCoverage coverage = mark_faces(level.parts, cuts, limits);
    if (coverage.covered_area > 0) level.ledge_area = coverage.ledge_area / coverage.covered_area;
    return level;
  }
  return {};
}

}  // namespace decomposition
