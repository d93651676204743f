// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/part_finish.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "decomposition/fit/column_measure.h"

namespace decomposition {
namespace {

constexpr int kSettlingSteps = 120;       // after welding
constexpr double kSettlingFirst = 0.006;  // share of the diagonal
constexpr int kVolumeRounds = 8;
constexpr double kLargestOffset = 0.02;    // of the volume correction / size of the part
constexpr double kVolumeTolerance = 1e-6;  // relative
constexpr double kSnapMargin = 1e-7;       // share of the size: drawn to a plane, still in general position

int planes_touched(const Vec3& p, const std::vector<Plane>& cell, double distance) {
  return static_cast<int>(std::count_if(
      cell.begin(), cell.end(), [&](const Plane& plane) { return std::abs(plane.signed_distance(p)) < distance; }));
}

/// Of every two points closer than the weld distance drops the one that lies on fewer cut planes.
std::vector<Vec3> welded(std::vector<Vec3> points, const std::vector<Plane>& cell) {
  const double size = bounding_box(points).diagonal();
  while (points.size() > 4) {
    double closest = kWeldShare * size;
    std::pair<std::size_t, std::size_t> pair;
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = a + 1; b < points.size(); ++b)
        if (const double distance = norm(points[a] - points[b]); distance < closest) closest = distance, pair = {a, b};
    if (pair.first == pair.second) break;
    const int on_a = planes_touched(points[pair.first], cell, kSnapShare * size);
    const int on_b = planes_touched(points[pair.second], cell, kSnapShare * size);
    if (on_a == on_b)
      points[pair.first] = 0.5 * (points[pair.first] + points[pair.second]);
    else if (on_b > on_a)
      points[pair.first] = points[pair.second];
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(pair.second));
  }
  return points;
}

/// Draws points that are near cut planes to them.
void snap(std::vector<Vec3>& points, const std::vector<Plane>& cell, const Vec3& centre) {
  const double size = bounding_box(points).diagonal();
  for (std::size_t v = 0; v < points.size(); ++v) {
    Vec3 p = points[v];
    for (int pass = 0; pass < 20; ++pass)
      for (const Plane& plane : cell)
        if (const double distance = plane.signed_distance(p); std::abs(distance) < kSnapShare * size)
          p -= distance * plane.normal;
    points[v] = project_into_cell(p, cell, centre, kSnapMargin * size * (1 + 0.01 * static_cast<double>(v)));
  }
}

std::vector<Vec3> hull_points(const SmallHull& hull, const std::vector<Vec3>& points) {
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (hull.is_vertex(static_cast<int>(v))) kept.push_back(points[v]);
  return kept;
}

/// Moves the points that lie on no cut plane along the surface's normals until the hull has the volume asked for.
void correct_volume(std::vector<Vec3>& points, const std::vector<Plane>& cell, const Vec3& centre, double volume) {
  const double size = bounding_box(points).diagonal();
  SmallHull hull;
  if (!hull.build(points)) return;
  std::vector<Vec3> direction(points.size());
  double rate = 0;  // dV / d(offset)
  std::vector<Vec3> area_sum(points.size());
  for (const auto& face : hull.faces()) {
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(face[k])]; };
    const Vec3 third = (1 / 6.0) * cross(at(1) - at(0), at(2) - at(0));
    for (const int v : face) area_sum[static_cast<std::size_t>(v)] += third;
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double length = norm(area_sum[v]);
    if (length == 0 || planes_touched(points[v], cell, kSnapShare * size) > 0) continue;
    direction[v] = (1 / length) * area_sum[v];
    rate += length;
  }
  if (rate == 0) return;
  const std::vector<Vec3> start = points;
  double offset = 0;
  for (int round = 0; round < kVolumeRounds; ++round) {
    const double lack = volume - hull.volume();
    if (std::abs(lack) < kVolumeTolerance * volume) return;
    offset = std::clamp(offset + lack / rate, -kLargestOffset * size, kLargestOffset * size);
    for (std::size_t v = 0; v < points.size(); ++v)
      if (norm(direction[v]) > 0)
        points[v] = project_into_cell(start[v] + offset * direction[v], cell, centre, kSnapMargin * size);
    if (!hull.build(points)) {
      points = start;
      return;
    }
  }
}

PartFit tidy(const Solid& solid, const std::vector<Plane>& cell, const Vec3& centre, PartFit fit, const FitPlan& plan) {
  fit.points = welded(std::move(fit.points), cell);
  snap(fit.points, cell, centre);
  FitPlan settling = plan;
  settling.steps = kSettlingSteps;
  settling.first_step = kSettlingFirst;
  // Welding has left vertices over: start them inside, the fit puts them where rock stands out.
  while (static_cast<int>(fit.points.size()) < plan.vertices) fit.points.push_back(centre);
  if (PartFit settled = fit_part(solid, cell, centre, fit.points, settling); settled.is_valid())
    fit.points = welded(std::move(settled.points), cell);
  snap(fit.points, cell, centre);
  SmallHull hull;
  if (!hull.build(fit.points)) return {};
  fit.points = hull_points(hull, fit.points);
  if (plan.volume > 0) correct_volume(fit.points, cell, centre, plan.volume);
  if (!hull.build(fit.points)) return {};
  fit.points = hull_points(hull, fit.points);
  fit.volume = hull.volume();
  return fit;
}

}  // namespace

PartFit finish_part(const Solid& solid, const std::vector<Plane>& cell, const RegionMoments& region,
                    const FitPlan& plan, int tries) {
  PartFit best;
  double least = std::numeric_limits<double>::infinity();
  ColumnMeasure measure(solid, 1);
  for (int attempt = 0; attempt < tries; ++attempt) {
    FitPlan variant = plan;
    variant.seed = sub_seed(plan.seed, static_cast<std::uint64_t>(attempt));
    PartFit fit = fit_part(solid, cell, region.centroid, start_points(solid, region, cell, variant), variant);
    if (!fit.is_valid()) continue;
    fit = tidy(solid, cell, region.centroid, std::move(fit), variant);
    SmallHull hull;
    if (!fit.is_valid() || !hull.build(fit.points)) continue;
    const double misfit = measure(fit.points, hull.faces()).misfit();
    if (misfit < least) least = misfit, best = std::move(fit);
  }
  return best;
}

}  // namespace decomposition
