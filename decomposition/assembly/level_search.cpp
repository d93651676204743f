// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/level_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/fit/column_measure.h"
#include "decomposition/fit/joint_misfit.h"
#include "decomposition/fit/part_finish.h"
#include "decomposition/fit/partition_finish.h"
#include "decomposition/geometry/parallel_for.h"

namespace decomposition {
namespace {

constexpr double kFinals = 2, kFinalsEnclosing = 3;  // of the best starts are finished, at effort 1
constexpr int kFinalSteps = 1200;
constexpr double kFinalFirst = 0.01, kFinalLast = 0.0007;  // share of the diagonal
constexpr double kLargeLedge = 0.2;                        // share of a face's area: splitting makes new small faces
constexpr double kBetterApart = 1.1;                       // joint error over that of single pieces
constexpr int kFitSteps = 500;                             // of parts fitted alone, beside exact pieces
constexpr double kFitTries = 3;                            // at effort 1
constexpr int kVolumeRounds = 4;           // of fitting them anew until the union has the solid's volume ...
constexpr double kVolumeAgreement = 2e-4;  // ... to this share
constexpr double kLeastFactor = 0.8, kMostFactor = 1.25;  // of the volume asked of parts fitted alone
// Share of the volume: inscribed parts with more void have lost the solid, so that none of its surface is in them.
constexpr double kLargestVoid = 0.005;
// What a cap of V vertices costs n enclosing parts of a ball: kCapCost / V / n^(2/3) of its volume, about.
constexpr double kCapCost = 2.2;
constexpr double kExactSnap = 1e-9;  // of the size: fitted points touch their cut planes already

Vec3 middle_of(const std::vector<std::vector<Vec3>>& parts) {
  Vec3 sum;
  std::size_t count = 0;
  for (const std::vector<Vec3>& points : parts)
    for (const Vec3& p : points) sum += p, ++count;
  return (1.0 / static_cast<double>(count)) * sum;
}

/// What parts hold of the void, over the solid's volume: none where they stay inside.
double void_share(const Solid& solid, const Partition& partition) {
  ColumnMeasure measure(solid, 1);
  double outside = 0;
  for (const std::vector<Vec3>& points : part_points(solid, partition)) {
    SmallHull hull;
    if (!hull.build(points)) return std::numeric_limits<double>::infinity();
    const ColumnOverlap overlap = measure(points, hull.faces());
    outside += overlap.volume - overlap.overlap;
  }
  return outside / solid.volume();
}

double volume_of(const std::vector<BuiltPart>& parts) {
  double volume = 0;
  for (const BuiltPart& part : parts) volume += figures({part.part}).smallest_volume;
  return volume;
}

/// What the parts of a bound leave between them and a mesh of that volume [m3]; infinite if there are none.
double bound_gap(const FoundLevel& level, double volume) {
  if (level.parts.empty()) return std::numeric_limits<double>::infinity();
  return std::abs(volume_of(level.parts) - volume);
}

/// The parts moved by a map of points and planes and built anew; none if one collapses.
template <class Map>
std::vector<BuiltPart> mapped(const std::vector<BuiltPart>& parts, double snap, const Map& map) {
  std::vector<BuiltPart> result;
  for (const BuiltPart& part : parts) {
    std::vector<Vec3> points;
    for (const catalog::Point& p : part.part.vertices) points.push_back(map(to_vec3(p)));
    Cell cell = part.cell;
    for (Plane& plane : cell.planes) plane = map(plane);
    std::optional<BuiltPart> built = build_part(points, cell, snap);
    if (!built) return {};
    result.push_back(std::move(*built));
  }
  return result;
}

/// Scales about a point.
struct Scaling {
  double factor;
  Vec3 centre;

  Vec3 operator()(const Vec3& p) const { return centre + factor * (p - centre); }
  Plane operator()(const Plane& plane) const {
    return {plane.normal, factor * plane.offset + (1 - factor) * dot(plane.normal, centre)};
  }
};

}  // namespace

int fewer_parts(int parts) { return static_cast<int>(std::bit_floor(static_cast<unsigned>(parts - 1))); }

FoundLevel nearer_to_bound(FoundLevel level, const FoundLevel& other, double volume) {
  return level.parts.empty() || bound_gap(other, volume) < bound_gap(level, volume) ? other : level;
}

std::vector<BuiltPart> LevelSearch::in_frame_of_mesh(std::vector<BuiltPart> parts) const {
  if (frame_.is_identity()) return parts;
  return mapped(parts, kExactSnap * diagonal_, [&](const auto& place) { return frame_.to_real(place); });
}

LevelSearch::LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options)
    : options_(options), frame_(mesh), race_(mesh, frame_, options) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertex_count());
  for (const catalog::Point& p : mesh.vertices) vertices.push_back(to_vec3(p));
  columns_volume_ = race_.solid().volume_inside({});
  diagonal_ = bounding_box(vertices).diagonal();
  volume_ = catalog::volume_moments(mesh).volume;
  smallest_volume_ = options.smallest_volume * volume_;
  smallest_thickness_ = options.smallest_thickness * smallest_extent(vertices, frame_);
}

LevelSearch::Finish LevelSearch::finished(Partition partition) const {
  JointPlan plan = race_.joint_plan();
  plan.steps = kFinalSteps * times_for_few(static_cast<int>(partition.leaves.size()));
  plan.first_step = kFinalFirst;
  plan.last_step = kFinalLast;
  if (!fit_by_rules(race_.solid(), partition, plan, race_.rules())) return {};
  if (options_.mode != FitMode::volume_true) {
    plan.rock_weight = 1;
    const Bound bound = options_.mode == FitMode::enclosing ? Bound::holds_solid : Bound::stays_inside;
    if (!fit_to_bound(race_.solid(), partition, plan, race_.rules(), bound)) return {};
    if (bound == Bound::stays_inside && void_share(race_.solid(), partition) > kLargestVoid) return {};
  }
  Finish finish;
  finish.misfit = joint_misfit(race_.solid(), partition);
  const Vec3 centre = middle_of(part_points(race_.solid(), partition));
  // What the rules take while the parts are built, and what own points could not make up for, comes back by scaling.
  for (int round = 0; round < kVolumeRounds; ++round) {
    finish.parts = built(partition);
    if (finish.parts.empty() || options_.mode != FitMode::volume_true) break;
    const double ratio = race_.solid().volume() / volume_of(finish.parts);
    if (std::abs(ratio - 1) < kVolumeAgreement) break;
    scale_volume(partition, centre, ratio);
  }
  finish.keeps_rules = keep_rules(finish.parts);
  finish.parts = in_frame_of_mesh(std::move(finish.parts));
  return finish;
}

bool LevelSearch::keep_rules(const std::vector<BuiltPart>& parts) const {
  return std::all_of(parts.begin(), parts.end(), [&](const BuiltPart& part) {
    const LevelFigures figure = figures({part.part});
    return figure.shortest_edge >= race_.rules().shortest_edge && figure.narrowest_face >= race_.rules().narrowest_face;
  });
}

std::vector<BuiltPart> LevelSearch::built(const Partition& partition) const {
  const std::vector<std::vector<Vec3>> points = part_points(race_.solid(), partition);
  std::vector<BuiltPart> parts;
  for (std::size_t a = 0; a < points.size(); ++a) {
    Cell cell;
    cell.planes = partition.planes_of(partition.leaves[a].sides);
    for (const CutSide& side : partition.leaves[a].sides) cell.cuts.push_back(side.cut);
    const double snap = kExactSnap * race_.solid().diagonal();
    // The parts keep to the rules by now, but for rounding: the last triangulation of a face may be another.
    std::optional<BuiltPart> part = options_.mode == FitMode::enclosing
                                        ? build_part(points[a], cell, snap)
                                        : build_part_by_rules(points[a], cell, snap, race_.rules());
    if (!part) return {};
    parts.push_back(std::move(*part));
  }
  return parts;
}

LevelSearch::Finish LevelSearch::found_jointly(int count) {
  const std::vector<TreeRace::Start>& all = race_.starts(count);
  const auto at_once = static_cast<std::size_t>(
      std::max(1.0, std::round((race_.plan().encloses ? kFinalsEnclosing : kFinals) * std::sqrt(options_.effort))));
  Finish best;
  for (std::size_t first = 0; first < all.size(); first += at_once) {
    std::vector<Finish> finishes(std::min(at_once, all.size() - first));
    parallel_for(static_cast<int>(finishes.size()), race_.threads(), [&](int k) {
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
  return best;
}

bool LevelSearch::is_acceptable(const std::vector<BuiltPart>& parts) const {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [&](const BuiltPart& part) {
    const LevelFigures figure = figures({part.part});
    return figure.smallest_thickness >= smallest_thickness_ && figure.smallest_volume >= smallest_volume_ &&
           figure.vertices <= options_.vertex_cap && (options_.face_cap == 0 || figure.faces <= options_.face_cap);
  });
}

std::optional<BuiltPart> LevelSearch::fitted_alone(const Piece& piece, int number, double volume_factor) const {
  if (piece.is_exact) return build_part(piece.fit.points, piece.cell, kExactSnap * race_.solid().diagonal());
  FitPlan plan;
  plan.vertices = options_.vertex_cap;
  // A hull of V points has at most 2 V - 4 faces: with fewer points none need go for the faces' sake.
  if (options_.face_cap > 0) plan.vertices = std::min(plan.vertices, options_.face_cap / 2 + 2);
  plan.steps = kFitSteps;
  plan.volume = volume_factor * piece.region.volume * race_.solid().volume() /
                columns_volume_;  // the targets add up to the mesh's volume
  plan.seed = sub_seed(options_.seed, 1000003ull + static_cast<std::uint64_t>(number));
  const int tries = std::max(1, static_cast<int>(std::lround(kFitTries * options_.effort)));
  const PartFit fit = finish_part(race_.solid(), piece.cell.planes, piece.region, plan, tries);
  if (!fit.is_valid()) return std::nullopt;
  const double snap = kSnapShare * bounding_box(fit.points).diagonal();
  return build_part_by_rules(fit.points, piece.cell, snap, race_.rules());
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
  return options_.mode == FitMode::volume_true && !race_.starts(count).empty() &&
         race_.solid().volume() + race_.starts(count).front().misfit > kBetterApart * apart;
}

/// The parts of all pieces, fitted alone; none if one cannot be.
std::vector<BuiltPart> LevelSearch::all_alone(const CutTree& tree, const std::vector<int>& pieces,
                                              double volume_factor) const {
  std::vector<std::optional<BuiltPart>> made(pieces.size());
  parallel_for(static_cast<int>(pieces.size()), race_.threads(), [&](int i) {
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

std::vector<BuiltPart> LevelSearch::found_apart(const CutTree& tree, int count) const {
  const std::vector<int> pieces = tree.pieces(count);
  std::vector<BuiltPart> best;
  double factor = 1, least = std::numeric_limits<double>::infinity();
  // Walls and rules keep some pieces from their volume: the others make up for it, as far as they can.
  for (int round = 0; round < kVolumeRounds; ++round) {
    std::vector<BuiltPart> parts = all_alone(tree, pieces, factor);
    if (parts.empty()) break;
    double fitted_volume = 0;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (!tree.piece(pieces[k]).is_exact) fitted_volume += figures({parts[k].part}).smallest_volume;
    const double lack = race_.solid().volume() - volume_of(parts);
    const bool is_done = fitted_volume == 0 || std::abs(lack) < kVolumeAgreement * race_.solid().volume();
    if (std::abs(lack) < least) {
      if (!is_done) parts = with_volume_of_mesh(parts);
      parts = in_frame_of_mesh(std::move(parts));
      if (is_acceptable(parts)) least = std::abs(lack), best = std::move(parts);
    }
    if (is_done) break;
    factor = std::clamp(factor * (1 + lack / fitted_volume), kLeastFactor, kMostFactor);
  }
  return best;
}

/// What is still missing or too much comes by scaling all parts and their cuts, which touches no rule and no seam.
std::vector<BuiltPart> LevelSearch::with_volume_of_mesh(const std::vector<BuiltPart>& parts) const {
  std::vector<std::vector<Vec3>> points;
  for (const BuiltPart& part : parts) {
    points.emplace_back();
    for (const catalog::Point& p : part.part.vertices) points.back().push_back(to_vec3(p));
  }
  const Scaling scaling{std::cbrt(race_.solid().volume() / volume_of(parts)), middle_of(points)};
  return mapped(parts, kExactSnap * race_.solid().diagonal(), scaling);
}

/// The hulls of a drawn solid's pieces; none if one breaks a cap. No fit could hold the pieces with less.
std::vector<BuiltPart> LevelSearch::found_as_hulls(const CutTree& tree, int count) const {
  std::vector<BuiltPart> parts;
  for (const int piece : tree.pieces(count)) {
    const Cell& cell = tree.piece(piece).cell;
    const std::vector<Vec3> points = capped_hull(race_.solid(), cell.planes, {options_.vertex_cap, options_.face_cap});
    std::optional<BuiltPart> part;
    if (!points.empty()) part = build_part(points, cell, kExactSnap * race_.solid().diagonal());
    if (!part) return {};
    parts.push_back(std::move(*part));
  }
  parts = in_frame_of_mesh(std::move(parts));
  return is_acceptable(parts) ? parts : std::vector<BuiltPart>{};
}

const FoundLevel& LevelSearch::find(int parts_asked) {
  if (const auto known = levels_.find(parts_asked); known != levels_.end()) return known->second;
  FoundLevel level = searched(parts_asked);
  if (options_.mode != FitMode::volume_true && parts_asked > 1) {
    // A bound may cost more parts more than they gain: then fewer are better.
    const FoundLevel& fewer = find(fewer_parts(parts_asked));
    level = nearer_to_bound(std::move(level), fewer, volume_);
  }
  return levels_[parts_asked] = std::move(level);
}

double LevelSearch::expected_misfit(int parts) {
  const CutTree& tree = race_.stage(0, parts);
  const std::vector<int> pieces = tree.pieces(parts);
  double misfit = 0;
  for (const int number : pieces) {
    const Piece& piece = tree.piece(number);
    if (!race_.plan().encloses || piece.is_exact)
      misfit += piece.error;
    else  // compared by hulls that are estimates and know no cap
      misfit += std::fmax(0.0, piece.error) +
                kCapCost / options_.vertex_cap * std::pow(pieces.size(), -2.0 / 3) * piece.region.volume;
  }
  return misfit * volume_ / race_.solid().volume();
}

FoundLevel LevelSearch::searched(int parts_asked) {
  for (int count = parts_asked; count > 0; --count) {
    // All trees find the exact pieces of a drawn solid, if it has any.
    const bool is_first = race_.solid().is_faceted() || race_.starts(count).empty();
    const CutTree& cut = is_first ? race_.first_tree(count) : race_.stage(race_.starts(count).front().tree, count);
    if (static_cast<int>(cut.pieces(count).size()) < count) continue;  // the tree has no more
    std::vector<BuiltPart> parts =
        options_.mode == FitMode::enclosing ? found_as_hulls(cut, count) : std::vector<BuiltPart>{};
    const bool is_apart = !parts.empty() || fits_better_apart(cut, count);
    if (parts.empty() && is_apart) parts = found_apart(cut, count);
    bool keeps_rules = keep_rules(parts);
    if (!is_apart) {
      Finish finish = found_jointly(count);
      parts = std::move(finish.parts);
      keeps_rules = finish.keeps_rules;
    }
    if (parts.empty()) continue;
    FoundLevel level = marked(std::move(parts), is_apart);
    level.keeps_rules = keeps_rules;
    return level;
  }
  return {};
}

FoundLevel LevelSearch::marked(std::vector<BuiltPart> parts, bool is_apart) const {
  int cut_count = 0;
  for (const BuiltPart& part : parts)
    for (const int cut : part.cell.cuts) cut_count = std::max(cut_count, cut + 1);
  std::vector<Plane> cuts(static_cast<std::size_t>(cut_count));
  for (const BuiltPart& part : parts)
    for (std::size_t k = 0; k < part.cell.cuts.size(); ++k)
      cuts[static_cast<std::size_t>(part.cell.cuts[k])] = part.cell.planes[k];
  SplitLimits limits{options_.vertex_cap};
  if (options_.face_cap > 0) limits.faces = options_.face_cap;
  // Parts fitted jointly share their outlines on the cuts, but for corners that the rules have cost some.
  if (!is_apart) limits.smallest_ledge = kLargeLedge;
  const CutCoverage coverage = mark_faces(parts, cuts, limits);
  return {std::move(parts), coverage};
}

}  // namespace decomposition
