// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/cut_candidates.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "decomposition/fit/column_measure.h"
#include "decomposition/search/column_hull.h"

namespace decomposition {
namespace {

constexpr std::array<double, 5> kQuantiles{0.2, 0.35, 0.5, 0.65, 0.8};
constexpr std::size_t kMostFacetPlanes = 150;              // tried per piece
constexpr double kLeastDepth = 0.02, kValleysApart = 0.2;  // of a piece's size: shallower is rough, nearer is the same
constexpr std::size_t kMostValleys = 5;
constexpr int kValleyTurns = 6, kSlopeDirections = 60;
constexpr double kNotAllowed = std::numeric_limits<double>::infinity();

/// Share of the points behind the plane.
double share_behind(const std::vector<Vec3>& points, const Plane& plane) {
  const auto behind =
      std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return plane.signed_distance(p) < 0; });
  return static_cast<double>(behind) / static_cast<double>(points.size());
}

/// Steepest rise of the occupancy around p, over three cells; zero where there is none.
Vec3 inward_slope(const Solid& solid, const Vec3& p) {
  const double reach = 3 * solid.cell();
  Vec3 slope;
  for (int d = 0; d < kSlopeDirections; ++d) {
    const Vec3 direction = spread_direction(d, kSlopeDirections);
    slope += solid.occupancy(p + reach * direction) * direction;
  }
  return slope;
}

struct SideScore {
  double misfit = kNotAllowed;
  bool is_exact = false;
};

/// A convex stand-in of one side, from a short fit or, where nothing may be left out, the hull.
PartFit side_fit(const CutTrial& trial, const std::vector<Plane>& cell, const RegionMoments& region,
                 const TrialPlan& how, std::uint64_t seed) {
  if (trial.plan.encloses) return column_hull(clipped(trial.columns, cell.back()), how.directions, how.rounds);
  FitPlan plan;
  plan.vertices = how.vertices;
  plan.steps = how.steps;
  plan.first_step = how.first_step;
  plan.last_step = how.last_step;
  plan.samples_along = how.samples_along;
  plan.seed = seed;
  return fit_part(trial.solid, cell, region.centroid, start_points(trial.solid, region, cell, plan), plan);
}

/// Misfit of a stand-in of one side; not allowed if the side is too small, too thin or does not fit at all.
SideScore score_side(const CutTrial& trial, const Plane& plane, const TrialPlan& how, std::uint64_t seed) {
  std::vector<Vec3> side;
  for (const Vec3& p : trial.points)
    if (plane.signed_distance(p) < 0) side.push_back(p);
  const double volume =
      trial.piece.region.volume * static_cast<double>(side.size()) / static_cast<double>(trial.points.size());
  if (side.size() < 20 || volume < trial.plan.smallest_volume) return {};
  std::vector<Plane> cell = trial.piece.cell.planes;
  cell.push_back(plane);
  const auto exact = exact_piece(trial.solid, cell, {trial.plan.vertex_cap, trial.plan.face_cap});
  const PartFit fit =
      exact ? PartFit{exact->points, exact->volume} : side_fit(trial, cell, moments_of_points(side, volume), how, seed);
  SmallHull hull;
  if (!hull.build(fit.points) || hull_thickness(hull, fit.points) < trial.plan.smallest_thickness) return {};
  // The hull holds all the rock of its side, whose volumes add up to the same for all cuts.
  const double misfit =
      trial.plan.encloses ? fit.volume : ColumnMeasure(trial.solid, how.stride)(fit.points, hull.faces()).misfit();
  return {misfit, exact.has_value()};
}

void add_facet_planes(const CutTrial& trial, std::vector<Plane>& planes) {
  const std::size_t before = planes.size();
  for (const Plane& facet : trial.solid.facet_planes()) {
    if (planes.size() - before >= kMostFacetPlanes) break;
    const double share = share_behind(trial.points, facet);
    if (share > 0 && share < 1) planes.push_back(facet);
  }
}

void add_central_planes(const RegionMoments& region, std::vector<Plane>& planes) {
  for (const Vec3& axis : region.semi_axes)
    if (norm(axis) > 0) planes.push_back({normalized(axis), dot(normalized(axis), region.centroid)});
}

Plane wall_of(const std::vector<Vec3>& points, const std::array<int, 3>& face) {
  const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(face[k])]; };
  const Vec3 normal = normalized(cross(at(1) - at(0), at(2) - at(0)));
  return {normal, dot(normal, at(0))};
}

/// Vertices of the mesh inside the piece that lie deepest in its stand-in, far from one another.
std::vector<Vec3> valleys(const CutTrial& trial) {
  const PartFit& fit = trial.piece.fit;
  SmallHull hull;
  if (!hull.build(fit.points)) return {};
  std::vector<Plane> walls;
  for (const std::array<int, 3>& face : hull.faces()) walls.push_back(wall_of(fit.points, face));
  const double size = std::cbrt(trial.piece.region.volume);
  std::vector<std::pair<double, Vec3>> places;
  for (const Vec3& p : trial.solid.vertices()) {
    double depth = std::numeric_limits<double>::infinity();
    for (const Plane& wall : walls) {
      depth = std::fmin(depth, -wall.signed_distance(p));
      if (depth < kLeastDepth * size) break;
    }
    if (depth < kLeastDepth * size) continue;
    if (std::all_of(trial.piece.cell.planes.begin(), trial.piece.cell.planes.end(),
                    [&](const Plane& cut) { return cut.signed_distance(p) < 0; }))
      places.push_back({depth, p});
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Vec3> result;
  for (const auto& [depth, p] : places) {
    if (result.size() >= kMostValleys) break;
    if (std::none_of(result.begin(), result.end(),
                     [&](const Vec3& other) { return norm(p - other) < kValleysApart * size; }))
      result.push_back(p);
  }
  return result;
}

/// Upright in the surface and turned about its normal, so that one runs along the valley; and from valley to valley.
void add_valley_planes(const CutTrial& trial, std::vector<Plane>& planes) {
  const std::vector<Vec3> places = valleys(trial);
  std::vector<Vec3> inward;
  for (const Vec3& p : places) inward.push_back(inward_slope(trial.solid, p));
  const auto add = [&](const Vec3& normal, const Vec3& p) {
    if (norm(normal) > 0) planes.push_back({normalized(normal), dot(normalized(normal), p)});
  };
  for (std::size_t a = 0; a < places.size(); ++a) {
    if (!(norm(inward[a]) > 0)) continue;
    Vec3 u, v;
    plane_axes(normalized(inward[a]), u, v);
    for (int turn = 0; turn < kValleyTurns; ++turn) {
      const double angle = std::numbers::pi * turn / kValleyTurns;
      add(std::cos(angle) * u + std::sin(angle) * v, places[a]);
    }
    for (std::size_t b = 0; b < a; ++b) {
      // Upright in both surfaces, as far as a plane can be.
      const Vec3 along = normalized(places[b] - places[a]);
      const Vec3 across_a = cross(along, inward[a]), across_b = cross(along, inward[b]);
      add(dot(across_a, across_b) > 0 ? across_a + across_b : across_a - across_b, places[a]);
    }
  }
}

}  // namespace

std::vector<Plane> candidate_planes(const CutTrial& trial, Random& random) {
  std::vector<Plane> planes;
  const Frame frame = random_frame(random);
  std::vector<double> heights(trial.points.size());
  for (int d = 0; d < trial.plan.directions; ++d) {
    // Half a sphere of directions: the other half gives the same planes.
    const Vec3 normal = frame(spread_direction(d, 2 * trial.plan.directions));
    for (std::size_t p = 0; p < heights.size(); ++p) heights[p] = dot(normal, trial.points[p]);
    auto begin = heights.begin();  // what lies before it is in its place
    for (const double quantile : kQuantiles) {
      const auto place = heights.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(heights.size()));
      std::nth_element(begin, place, heights.end());
      planes.push_back({normal, *place});
      begin = place;
    }
  }
  if (trial.solid.is_faceted()) {
    add_facet_planes(trial, planes);
  } else if (!trial.plan.encloses) {  // what lowers the hulls of a piece's halves most at once is no better in the end
    add_central_planes(trial.piece.region, planes);
    add_valley_planes(trial, planes);
  }
  return planes;
}

Plane nudged_plane(const Vec3& middle, double size, const Plane& plane, double reach, Random& random) {
  const Vec3 pivot = middle - plane.signed_distance(middle) * plane.normal;
  Plane result;
  result.normal = normalized(plane.normal + (2 * reach) * random.unit_vector());
  result.offset = dot(result.normal, pivot) + reach * size * (2 * random.uniform() - 1);
  return result;
}

CutScore score_cut(const CutTrial& trial, const Plane& plane, const TrialPlan& fit, std::uint64_t seed) {
  const SideScore first = score_side(trial, plane, fit, seed);
  if (first.misfit == kNotAllowed) return {plane, kNotAllowed, false};
  const SideScore second = score_side(trial, plane.reversed(), fit, seed);
  return {plane, first.misfit + second.misfit, first.is_exact && second.is_exact};
}

}  // namespace decomposition
