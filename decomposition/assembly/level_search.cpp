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
constexpr double kTrees = 3;            // at effort 1
constexpr double kDirections = 24, kRefits = 6;
constexpr int kManyParts = 8;       // beyond, only the trees that are best at this number grow on ...
constexpr std::size_t kGrowOn = 1;  // ... so many
constexpr int kMostTimes = 4;
constexpr int kMovingSteps = 150;  // of the joint fits that move a tree's cuts while it grows
constexpr int kTrialSteps = 400;   // of the joint fits that compare trees
constexpr double kTrialFirst = 0.02, kTrialLast = 0.001;
constexpr int kFinalSteps = 1200;
constexpr double kFinalFirst = 0.01, kFinalLast = 0.0007;  // share of the diagonal
constexpr double kCutRate = 0.5;
constexpr double kBoundWeight = 4;   // of what a bound forbids against what it allows, while the bound is not kept yet
constexpr int kFitSteps = 500;       // of parts fitted alone, beside exact pieces
constexpr double kFitTries = 3;      // at effort 1
constexpr double kExactSnap = 1e-9;  // of the size: fitted points touch their cut planes already

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Where parts are few their fits are cheap, and worth more tries and steps.
int times_for_few(int count) { return std::clamp(kManyParts / count, 1, kMostTimes); }

/// A tree's cuts are moved to suit all parts when it has this many: early, where the later cuts hang on them.
bool moves_cuts_at(int count) { return count == 2 || count == 4 || count == 16; }

}  // namespace

LevelSearch::LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options)
    : options_(options), solid_(mesh, kFieldCells), coarse_(mesh, kSearchCells), started_(cpu_seconds()) {
  columns_volume_ = solid_.volume_inside({});
  plan_.directions = std::max(4, static_cast<int>(std::lround(kDirections * std::fmin(1.0, options.effort))));
  plan_.refits = std::max(2, static_cast<int>(std::lround(kRefits * std::fmin(1.0, options.effort))));
  plan_.polishing_rounds = 2;
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

SearchPlan LevelSearch::search_plan(std::uint64_t tree) const {
  SearchPlan plan = plan_;
  plan.seed = sub_seed(options_.seed, 2000003ull + tree);
  plan.threads = tree == 0 ? threads() : 1;
  return plan;
}

JointPlan LevelSearch::joint_plan() const {
  JointPlan plan;
  plan.steps = kTrialSteps;
  plan.first_step = kTrialFirst;
  plan.last_step = kTrialLast;
  plan.cut_rate = kCutRate;
  if (options_.mode == FitMode::volume_true) plan.volume = solid_.volume();
  if (options_.mode == FitMode::enclosing) plan.rock_weight = kBoundWeight;
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

const CutTree& LevelSearch::stage(std::size_t tree, int count) {
  while (trees_.size() <= tree) trees_.push_back(std::make_unique<TreeStages>());
  TreeStages& stages = *trees_[tree];
  if (stages.empty()) stages.emplace(1, CutTree(coarse_, search_plan(tree)));
  for (int next = stages.rbegin()->first + 1; next <= count; ++next) {
    CutTree grown = stages.at(next - 1);
    // Cuts of a drawn solid stay on its facets.
    if (moves_cuts_at(next - 1) && grown.cuts().size() + 2 == static_cast<std::size_t>(next) && !solid_.is_faceted()) {
      Partition partition = start_partition(coarse_, grown, next - 1, options_.vertex_cap, options_.seed);
      JointPlan plan = joint_plan();
      plan.steps = kMovingSteps;
      if (fit_jointly(coarse_, partition, plan)) {
        std::vector<Plane> planes;
        for (const Cut& cut : partition.cuts) planes.push_back(cut.plane);
        grown.move_cuts(planes);
      }
    }
    grown.grow(next);
    stages.emplace(next, std::move(grown));
  }
  return stages.at(count);
}

bool LevelSearch::has_time_for_another(std::size_t trees, double seconds_each) const {
  if (options_.time_budget <= 0) return trees < static_cast<std::size_t>(std::max(1.0, kTrees * options_.effort));
  return trees == 0 || cpu_seconds() - started_ + 1.5 * seconds_each < options_.time_budget;
}

std::optional<LevelSearch::Start> LevelSearch::start_from(std::size_t tree, int count, int variant) {
  Start start;
  start.tree = tree;
  JointPlan plan = joint_plan();
  plan.seed = sub_seed(options_.seed, 100 * tree + static_cast<std::uint64_t>(variant));
  start.partition = start_partition(solid_, stage(tree, count), count, options_.vertex_cap, plan.seed);
  if (trim(solid_, start.partition, rules(), Trim::caps).empty()) return std::nullopt;
  if (!fit_jointly(solid_, start.partition, plan)) return std::nullopt;
  start.misfit = joint_misfit(solid_, start.partition);
  return start;
}

void LevelSearch::add_starts(std::size_t tree, int count, std::vector<Start>& result) {
  for (int variant = 0; variant < times_for_few(count); ++variant)
    if (auto start = start_from(tree, count, variant)) result.push_back(std::move(*start));
}

const std::vector<LevelSearch::Start>& LevelSearch::starts(int count) {
  if (const auto known = starts_.find(count); known != starts_.end()) return known->second;
  std::vector<std::size_t> racing;
  std::vector<Start> result;
  if (count > kManyParts) {
    for (const Start& start : starts(kManyParts))
      if (racing.size() < kGrowOn) racing.push_back(start.tree);
    for (const std::size_t tree : racing) add_starts(tree, count, result);
  } else {
    const double begin = cpu_seconds();
    for (std::size_t tree = 0;
         has_time_for_another(tree, tree > 0 ? (cpu_seconds() - begin) / static_cast<double>(tree) : 0); ++tree)
      add_starts(tree, count, result);
  }
  std::stable_sort(result.begin(), result.end(), [](const Start& a, const Start& b) { return a.misfit < b.misfit; });
  return starts_[count] = std::move(result);
}

std::vector<BuiltPart> LevelSearch::fitted_jointly(Partition partition) const {
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
  const std::vector<std::vector<Vec3>> points = part_points(solid_, partition);
  std::vector<BuiltPart> parts;
  for (std::size_t a = 0; a < points.size(); ++a) {
    Cell cell;
    cell.planes = partition.planes_of(partition.leaves[a].sides);
    for (const CutSide& side : partition.leaves[a].sides) cell.cuts.push_back(side.cut);
    std::optional<BuiltPart> part = build_part(points[a], cell, kExactSnap * solid_.diagonal());
    if (!part) return {};
    parts.push_back(std::move(*part));
  }
  return parts;
}

FoundLevel LevelSearch::found_jointly(int count) {
  for (const Start& start : starts(count)) {
    FoundLevel level;
    level.parts = fitted_jointly(start.partition);
    if (!is_acceptable(level.parts)) continue;
    return level;
  }
  return {};
}

bool LevelSearch::is_acceptable(const std::vector<BuiltPart>& parts) const {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [&](const BuiltPart& part) {
    const LevelFigures figure = figures({part.part});
    return figure.smallest_thickness >= plan_.smallest_thickness && figure.smallest_volume >= plan_.smallest_volume &&
           figure.vertices <= options_.vertex_cap && (options_.face_cap == 0 || figure.faces <= options_.face_cap);
  });
}

std::optional<BuiltPart> LevelSearch::fitted_alone(const Piece& piece, int number) const {
  if (piece.is_exact) return build_part(piece.fit.points, piece.cell, kExactSnap * solid_.diagonal());
  FitPlan plan;
  plan.vertices = options_.vertex_cap;
  plan.steps = kFitSteps;
  plan.volume = piece.region.volume * solid_.volume() / columns_volume_;  // the targets add up to the mesh's volume
  plan.seed = sub_seed(options_.seed, 1000003ull + static_cast<std::uint64_t>(number));
  const int tries = std::max(1, static_cast<int>(std::lround(kFitTries * options_.effort)));
  const PartFit fit = finish_part(solid_, piece.cell.planes, piece.region, plan, tries);
  if (!fit.is_valid()) return std::nullopt;
  const double snap = kSnapShare * bounding_box(fit.points).diagonal();
  std::optional<BuiltPart> part = build_part(fit.points, piece.cell, snap);
  if (!part) return part;
  std::vector<Vec3> points;
  for (const catalog::Point& p : part->part.vertices) points.push_back(to_vec3(p));
  trim_points(points, piece.cell.planes, solid_.diagonal(), rules());
  return build_part(points, piece.cell, kExactSnap * solid_.diagonal());
}

FoundLevel LevelSearch::found_apart(const CutTree& tree, int count) const {
  const std::vector<int> pieces = tree.pieces(count);
  std::vector<std::optional<BuiltPart>> made(pieces.size());
  parallel_for(static_cast<int>(pieces.size()), threads(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    made[k] = fitted_alone(tree.piece(pieces[k]), pieces[k]);
  });
  FoundLevel level;
  for (std::optional<BuiltPart>& part : made) {
    if (!part) return {};
    level.parts.push_back(std::move(*part));
  }
  if (!is_acceptable(level.parts)) return {};
  return level;
}

FoundLevel LevelSearch::find(int parts_asked) {
  for (int count = parts_asked; count > 0; --count) {
    const CutTree& first = stage(0, count);
    const std::vector<int> pieces = first.pieces(count);
    if (static_cast<int>(pieces.size()) < count) continue;  // the tree has no more
    const bool has_exact =
        std::any_of(pieces.begin(), pieces.end(), [&](int piece) { return first.piece(piece).is_exact; });
    FoundLevel level = has_exact ? found_apart(first, count) : found_jointly(count);
    if (level.parts.empty()) continue;
    std::vector<Plane> cuts;
    int cut_count = 0;
    for (const BuiltPart& part : level.parts)
      for (const int cut : part.cell.cuts) cut_count = std::max(cut_count, cut + 1);
    cuts.resize(static_cast<std::size_t>(cut_count));
    for (const BuiltPart& part : level.parts)
      for (std::size_t k = 0; k < part.cell.cuts.size(); ++k)
        cuts[static_cast<std::size_t>(part.cell.cuts[k])] = part.cell.planes[k];
    // Parts fitted jointly share their outlines on the cuts: nothing to split.
    const CutCoverage coverage = mark_faces(level.parts, cuts, has_exact ? options_.vertex_cap : 0,
                                            has_exact && options_.face_cap > 0 ? options_.face_cap : 1000);
    if (coverage.covered_area > 0) level.ledge_area = coverage.ledge_area / coverage.covered_area;
    return level;
  }
  return {};
}

}  // namespace decomposition
