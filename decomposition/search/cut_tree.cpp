// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/cut_tree.h"

#include <algorithm>
#include <limits>

#include "decomposition/fit/column_measure.h"
#include "decomposition/geometry/parallel_for.h"
#include "decomposition/search/column_hull.h"
#include "decomposition/search/cut_candidates.h"

namespace decomposition {
namespace {

constexpr int kPointsAPiece = 2000;
constexpr TrialPlan kCoarse{26, 0, 24, 7, 2, 4, 0.03, 0.006};
constexpr TrialPlan kFine{26, 1, 32, 40, 3, 2, 0.02, 0.003};
constexpr FitPlan kComparison{32, 120, 0.02, 0.0015, 4, 0, 1};
constexpr int kDirections = 26, kSupportRounds = 2;
constexpr int kColumnStride = 2;      // of the columns whose hulls are compared
constexpr double kFirstReach = 0.06;  // of polishing moves, halved every round
constexpr int kMovesARound = 12;
constexpr int kPolishingRounds = 4, kPolishingMoves = 6;  // of hulls, a cut
constexpr double kPolishingReach = 0.05, kPolishingDecay = 0.6;
constexpr double kSmallestGain = 1e-4;   // of the solid's volume: below, a cut is noise
constexpr double kHopeless = 0.3;        // error of a piece / its volume: more, and the gain of one cut says little
constexpr double kDistinctAngle = 0.97;  // cosine: two candidates nearer than this and ...
constexpr double kDistinctShift = 0.05;  // ... with offsets nearer than this share of the piece's size are one

/// The first `count` of the sorted scores that are not almost the same cut.
std::vector<CutScore> distinct(const std::vector<CutScore>& sorted, std::size_t count, double size) {
  std::vector<CutScore> chosen;
  for (const CutScore& score : sorted) {
    if (chosen.size() >= count || !std::isfinite(score.misfit)) break;
    const bool is_new = std::none_of(chosen.begin(), chosen.end(), [&](const CutScore& other) {
      const double cosine = dot(other.plane.normal, score.plane.normal);
      const double shift = other.plane.offset - (cosine > 0 ? 1 : -1) * score.plane.offset;
      return std::abs(cosine) > kDistinctAngle && std::abs(shift) < kDistinctShift * size;
    });
    if (is_new) chosen.push_back(score);
  }
  return chosen;
}

/// The cell with its cuts in new places near by.
Cell placed(Cell cell, const std::vector<Plane>& cuts) {
  for (std::size_t k = 0; k < cell.planes.size(); ++k) {
    const Plane& moved = cuts[static_cast<std::size_t>(cell.cuts[k])];
    cell.planes[k] = dot(cell.planes[k].normal, moved.normal) > 0 ? moved : moved.reversed();
  }
  return cell;
}

}  // namespace

/// Convex stand-in of the solid in a cell, and its error.
Piece CutTree::make_piece(Cell cell, std::uint64_t seed) const {
  Piece piece;
  piece.cell = std::move(cell);
  Random random(seed);
  const std::vector<Vec3> points = solid_.points_inside(piece.cell.planes, kPointsAPiece, random);
  if (points.size() < 20) return piece;
  piece.region = moments_of_points(points, solid_.volume_inside(piece.cell.planes));
  if (const auto exact = exact_piece(solid_, piece.cell.planes, {plan_.vertex_cap, plan_.face_cap})) {
    piece.is_exact = true;
    piece.fit = {exact->points, exact->volume};
    piece.region.volume = exact->volume;
    return piece;
  }
  if (plan_.encloses) {
    piece.fit = column_hull(solid_.stretches_inside(piece.cell.planes, kColumnStride), kDirections, kSupportRounds);
    piece.error = piece.fit.volume - piece.region.volume;
    return piece;
  }
  FitPlan plan = kComparison;
  plan.seed = seed;
  piece.fit = fit_part(solid_, piece.cell.planes, piece.region.centroid,
                       start_points(solid_, piece.region, piece.cell.planes, plan), plan);
  SmallHull hull;
  if (piece.fit.is_valid() && hull.build(piece.fit.points))
    piece.error = piece.region.volume + ColumnMeasure(solid_, 1)(piece.fit.points, hull.faces()).misfit();
  else
    piece.fit = {};
  return piece;
}

CutTree::CutTree(const Solid& solid, const SearchPlan& plan) : solid_(solid), plan_(plan) {
  nodes_.emplace_back();
  nodes_.back().piece = make_piece({}, sub_seed(plan.seed, 0));
}

bool CutTree::is_allowed(const Piece& piece) const {
  SmallHull hull;
  return piece.fit.is_valid() && piece.region.volume >= plan_.smallest_volume &&
         (piece.is_exact || hull.build(piece.fit.points)) &&
         (piece.is_exact || hull_thickness(hull, piece.fit.points) >= plan_.smallest_thickness);
}

std::optional<CutTree::Cut> CutTree::best_cut(const Piece& piece, std::uint64_t seed, CompareBy by) const {
  const bool is_tight = piece.error < kSmallestGain * solid_.volume() && !(plan_.encloses && by == CompareBy::fits);
  if (piece.is_exact || is_tight) return std::nullopt;
  Random random(seed);
  const std::vector<Vec3> points = solid_.points_inside(piece.cell.planes, kPointsAPiece, random);
  SearchPlan plan = plan_;
  plan.encloses = by == CompareBy::hulls;
  CutTrial trial{solid_, plan, piece, points};
  if (plan.encloses) trial.columns = solid_.stretches_inside(piece.cell.planes, kColumnStride);
  const auto score_all = [&](const std::vector<Plane>& planes, const TrialPlan& fit) {
    std::vector<CutScore> scores(planes.size());
    // The same seed for all: candidates are compared under common random numbers.
    parallel_for(static_cast<int>(planes.size()), plan_.threads, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      scores[k] = score_cut(trial, planes[k], fit, seed);
    });
    std::stable_sort(scores.begin(), scores.end(),
                     [](const CutScore& a, const CutScore& b) { return a.misfit < b.misfit; });
    return scores;
  };
  const auto planes_of = [](const std::vector<CutScore>& scores) {
    std::vector<Plane> planes;
    for (const CutScore& score : scores) planes.push_back(score.plane);
    return planes;
  };
  const auto refits = static_cast<std::size_t>(plan_.refits);
  std::vector<CutScore> best = score_all(
      planes_of(distinct(score_all(candidate_planes(trial, random), kCoarse), refits, std::cbrt(piece.region.volume))),
      kFine);
  if (best.empty() || !std::isfinite(best.front().misfit)) return std::nullopt;
  double reach = kFirstReach;
  for (int round = 0; round < plan_.polishing_rounds && !best.front().is_exact; ++round, reach /= 2) {
    std::vector<Plane> planes{best.front().plane};
    for (int move = 0; move < kMovesARound; ++move)
      planes.push_back(nudged_plane(piece.region.centroid, std::cbrt(piece.region.volume),
                                    best[move % 3 == 2 && best.size() > 1 ? 1 : 0].plane, reach, random));
    best = score_all(planes, kFine);
  }
  Cut cut;
  cut.plane = best.front().plane;
  const int number = static_cast<int>(cuts_.size());
  parallel_for(2, plan_.threads, [&](int side) {
    const Plane plane = side == 0 ? cut.plane : cut.plane.reversed();
    cut.halves[static_cast<std::size_t>(side)] = make_piece(piece.cell.half(number, plane), sub_seed(seed, 1 + side));
  });
  if (!is_allowed(cut.halves[0]) || !is_allowed(cut.halves[1])) return std::nullopt;
  cut.gain = piece.error - cut.halves[0].error - cut.halves[1].error;
  return cut;
}

/// The leaf whose cut gains most; none if no cut is worth making.
CutTree::Node* CutTree::most_gainful_leaf() {
  Node* chosen = nullptr;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.split >= 0) continue;
    if (!node.was_searched) {
      node.best = best_cut(node.piece, sub_seed(plan_.seed, 1 + n),
                           plan_.encloses || plan_.compares_hulls ? CompareBy::hulls : CompareBy::fits);
      node.was_searched = true;
    }
    if (node.best && (!chosen || node.best->gain > chosen->best->gain)) chosen = &node;
  }
  return chosen && chosen->best->gain >= kSmallestGain * solid_.volume() ? chosen : nullptr;
}

/// Where no cut gains, by the other measure. Of fits: the leaf that fits worst, of thin shells and the like, where
/// nothing fits before the last cut, cut so that the halves' hulls hold least. Of hulls: the largest leaf, cut so that
/// capped parts fit the halves best. None if all fit or cannot be cut.
CutTree::Node* CutTree::leaf_without_gain() {
  Node* chosen = nullptr;
  const auto urgency = [&](const Piece& piece) { return plan_.encloses ? piece.region.volume : piece.error; };
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.split >= 0) continue;
    if (!plan_.encloses && node.piece.error < kHopeless * node.piece.region.volume) continue;
    if (!node.was_searched_otherwise) {
      node.best =
          best_cut(node.piece, sub_seed(plan_.seed, 1 + n), plan_.encloses ? CompareBy::fits : CompareBy::hulls);
      node.was_searched_otherwise = true;
    }
    if (node.best && (!chosen || urgency(node.piece) > urgency(chosen->piece))) chosen = &node;
  }
  return chosen;
}

void CutTree::make_cut(Node& leaf) {
  const int number = static_cast<int>(cuts_.size());
  Cut cut = std::move(*leaf.best);
  leaf.best.reset();
  leaf.split = number;
  leaf.halves = static_cast<int>(nodes_.size());
  cuts_.push_back(cut.plane);
  divided_.push_back(static_cast<int>(&leaf - nodes_.data()));
  for (Piece& half : cut.halves) {
    half.cell.cuts.back() = number;  // cuts may have been made since this one was found
    Node node;
    node.piece = std::move(half);
    node.born = number + 1;
    nodes_.push_back(std::move(node));
  }
}

void CutTree::grow(int count) {
  while (static_cast<int>(cuts_.size()) + 1 < count) {
    Node* chosen = most_gainful_leaf();
    if (!chosen) chosen = leaf_without_gain();
    if (!chosen) return;
    make_cut(*chosen);
  }
}

bool CutTree::has_whole_halves(const Node& node) const {
  if (node.split < 0) return false;
  const auto half = nodes_.begin() + node.halves;
  return half[0].split < 0 && half[1].split < 0;
}

/// Takes a cut away whose halves are leaves. It stays known as the best of its piece.
void CutTree::merge(Node& divided) {
  const int cut = divided.split, first = divided.halves;
  Cut best;
  best.gain = divided.piece.error - nodes_[static_cast<std::size_t>(first)].piece.error -
              nodes_[static_cast<std::size_t>(first) + 1].piece.error;
  best.plane = cuts_[static_cast<std::size_t>(cut)];
  for (int side = 0; side < 2; ++side)
    best.halves[static_cast<std::size_t>(side)] = std::move(nodes_[static_cast<std::size_t>(first + side)].piece);
  divided.best = std::move(best);
  divided.split = -1;
  divided.is_merged = false;
  nodes_.erase(nodes_.begin() + first, nodes_.begin() + first + 2);
  cuts_.erase(cuts_.begin() + cut);
  divided_.erase(divided_.begin() + cut);
  for (int& node : divided_)
    if (node > first) node -= 2;
  for (Node& node : nodes_) {
    if (node.halves > first) node.halves -= 2;
    if (node.split > cut) --node.split;
    if (node.born > cut + 1) --node.born;
    for (int& number : node.piece.cell.cuts)
      if (number > cut) --number;
    if (!node.best) continue;
    for (Piece& half : node.best->halves)
      for (int& number : half.cell.cuts)
        if (number > cut) --number;
  }
}

/// Least sum of errors of each node's cell in 0, 1, ... `count` pieces, infinite where it cannot have so many.
std::vector<std::vector<double>> CutTree::least_errors(int count) {
  const auto most = static_cast<std::size_t>(count);
  std::vector<std::vector<double>> least(nodes_.size(),
                                         std::vector<double>(most + 1, std::numeric_limits<double>::infinity()));
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // halves come after what they are halves of
    Node& node = nodes_[n];
    if (node.is_outdated) {
      node.piece = make_piece(node.piece.cell, sub_seed(plan_.seed, 6000000 + n));
      node.is_outdated = false;
    }
    least[n][1] = node.piece.error;
    if (node.split < 0) continue;
    const auto half = static_cast<std::size_t>(node.halves);
    for (std::size_t k = 2; k <= most; ++k)
      for (std::size_t i = 1; i < k; ++i) least[n][k] = std::fmin(least[n][k], least[half][i] + least[half + 1][k - i]);
  }
  return least;
}

/// Marks what has to be merged for the node's cell to be in so many pieces of the least error.
void CutTree::mark_merged(int number, int count, const std::vector<std::vector<double>>& least) {
  Node& node = nodes_[static_cast<std::size_t>(number)];
  if (node.split < 0) return;
  node.is_merged = count <= 1;
  const auto half = static_cast<std::size_t>(node.halves);
  int in_first = 1;
  for (int i = 2; i < count; ++i) {
    const auto error = [&](int k) {
      return least[half][static_cast<std::size_t>(k)] + least[half + 1][static_cast<std::size_t>(count - k)];
    };
    if (error(i) < error(in_first)) in_first = i;
  }
  mark_merged(node.halves, in_first, least);
  mark_merged(node.halves + 1, count - in_first, least);
}

void CutTree::merge_down(int count) {
  if (static_cast<int>(cuts_.size()) < count) return;
  mark_merged(0, count, least_errors(count));
  const auto next = [&] {
    return std::find_if(nodes_.begin(), nodes_.end(),
                        [&](const Node& node) { return node.is_merged && has_whole_halves(node); });
  };
  for (auto node = next(); node != nodes_.end(); node = next()) merge(*node);
}

/// Sum of the hulls of all leaves with these cuts; those that do not lie at `cut` are taken from `by_node` if known
/// there, the others are put there.
double CutTree::hull_volume(const std::vector<Plane>& cuts, int cut, std::vector<double>& by_node) const {
  double sum = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].split >= 0) continue;
    const Cell& cell = nodes_[n].piece.cell;
    if (std::find(cell.cuts.begin(), cell.cuts.end(), cut) != cell.cuts.end() || by_node[n] < 0) {
      std::vector<Stretch> columns = solid_.stretches_inside(placed(cell, cuts).planes, kColumnStride);
      const PartFit fit = column_hull(columns, kDirections, kSupportRounds);
      SmallHull hull;
      double volume = 0;
      for (const Stretch& s : columns) volume += s.high - s.low;
      volume *= kColumnStride * kColumnStride * solid_.rays().cell * solid_.rays().cell;
      const bool is_allowed = fit.is_valid() && volume >= plan_.smallest_volume && hull.build(fit.points) &&
                              hull_thickness(hull, fit.points) >= plan_.smallest_thickness;
      by_node[n] = is_allowed ? fit.volume : std::numeric_limits<double>::infinity();
    }
    sum += by_node[n];
  }
  return sum;
}

void CutTree::polish_hulls() {
  std::vector<Plane> cuts = cuts_;
  std::vector<double> by_node(nodes_.size(), -1.0);
  double least = hull_volume(cuts, -1, by_node);
  Random random(sub_seed(plan_.seed, 7000000 + cuts.size()));
  double reach = kPolishingReach;
  for (int round = 0; round < kPolishingRounds; ++round, reach *= kPolishingDecay)
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const Piece& divided = nodes_[static_cast<std::size_t>(divided_[c])].piece;
      for (int move = 0; move < kPolishingMoves; ++move) {
        std::vector<Plane> moved = cuts;
        moved[c] = nudged_plane(divided.region.centroid, std::cbrt(divided.region.volume), cuts[c], reach, random);
        std::vector<double> volumes = by_node;
        const double volume = hull_volume(moved, static_cast<int>(c), volumes);
        if (!(volume < least)) continue;
        least = volume;
        cuts = std::move(moved);
        by_node = std::move(volumes);
      }
    }
  move_cuts(cuts);
}

void CutTree::move_cuts(const std::vector<Plane>& cuts) {
  cuts_ = cuts;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    node.piece.cell = placed(node.piece.cell, cuts);
    node.is_outdated = node.split >= 0;
    if (node.is_outdated) continue;
    node.piece = make_piece(node.piece.cell, sub_seed(plan_.seed, 5000000 + n));
    node.was_searched = node.was_searched_otherwise = false;
    node.best.reset();
  }
}

std::vector<int> CutTree::pieces(int count) const {
  const int cuts = std::min(count - 1, static_cast<int>(cuts_.size()));
  std::vector<int> result;
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].born <= cuts && (nodes_[n].split < 0 || nodes_[n].split >= cuts))
      result.push_back(static_cast<int>(n));
  return result;
}

}  // namespace decomposition
