// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/cut_candidates.h"

#include <algorithm>
#include <limits>

#include "decomposition/fit/column_measure.h"
#include "decomposition/search/column_hull.h"

namespace decomposition {
namespace {

constexpr std::array<double, 5> kQuantiles{0.2, 0.35, 0.5, 0.65, 0.8};
constexpr std::size_t kMostFacetPlanes = 150;  // tried per piece
constexpr double kNotAllowed = std::numeric_limits<double>::infinity();

/// Share of the points behind the plane.
double share_behind(const std::vector<Vec3>& points, const Plane& plane) {
  const auto behind =
      std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return plane.signed_distance(p) < 0; });
  return static_cast<double>(behind) / static_cast<double>(points.size());
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
      trial.region.volume * static_cast<double>(side.size()) / static_cast<double>(trial.points.size());
  if (side.size() < 20 || volume < trial.plan.smallest_volume) return {};
  std::vector<Plane> cell = trial.cell.planes;
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

}  // namespace

std::vector<Plane> candidate_planes(const CutTrial& trial, Random& random) {
  std::vector<Plane> planes;
  std::vector<double> heights(trial.points.size());
  const auto add_quantiles = [&](const Vec3& normal) {
    for (std::size_t p = 0; p < heights.size(); ++p) heights[p] = dot(normal, trial.points[p]);
    std::sort(heights.begin(), heights.end());
    for (const double quantile : kQuantiles)
      planes.push_back({normal, heights[static_cast<std::size_t>(quantile * static_cast<double>(heights.size()))]});
  };
  const Frame frame = random_frame(random);
  // Half a sphere of directions: the other half gives the same planes.
  for (int d = 0; d < trial.plan.directions; ++d) add_quantiles(frame(spread_direction(d, 2 * trial.plan.directions)));
  for (const Vec3& axis : trial.region.semi_axes) {
    if (!(norm(axis) > 0)) continue;
    const Vec3 normal = normalized(axis);
    add_quantiles(normal);
    planes.push_back({normal, dot(normal, trial.region.centroid)});
  }
  const std::size_t random_planes = planes.size();
  for (const Plane& facet : trial.solid.facet_planes()) {
    if (planes.size() - random_planes >= kMostFacetPlanes) break;
    const double share = share_behind(trial.points, facet);
    if (share > 0 && share < 1) planes.push_back(facet);
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
