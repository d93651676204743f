// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/part_fit.h"

#include <algorithm>

#include "decomposition/fit/bumps.h"
#include "decomposition/fit/face_forces.h"

namespace decomposition {
namespace {

constexpr double kMomentum = 0.6;
// Behind its cut planes a vertex keeps this share of the diagonal (times 1 to 2, by its number), so that no four
// vertices are exactly coplanar while the fit runs; assembly puts them on the plane.
constexpr double kCellMargin = 2e-6;
constexpr int kProjectionPasses = 25;
constexpr double kLongestDetour = 4;  // of a projection / the largest distance to a plane
constexpr int kReviveEvery = 12;      // steps between putting back vertices that fell inside the hull
constexpr double kReviveUntil = 0.9;  // share of the steps
constexpr double kVolumeGain = 0.4;   // of the integral steering of the volume, per step and relative volume error
constexpr double kLargestSteering = 0.5;

double margin_of(std::size_t point, double diagonal) {
  const double spread = 0.6180339887498949 * static_cast<double>(point + 1);
  return kCellMargin * diagonal * (1 + spread - std::floor(spread));
}

/// Fit of one part; the members are the state that changes from step to step.
class Fitter {
 public:
  Fitter(const Solid& solid, const std::vector<Plane>& cell, const Vec3& centre, const FitPlan& plan)
      : solid_(solid), cell_(cell), centre_(centre), plan_(plan), random_(plan.seed) {}

  PartFit run(std::vector<Vec3> points) {
    points_ = std::move(points);
    velocity_.assign(points_.size(), {});
    for (std::size_t v = 0; v < points_.size(); ++v) put(v, points_[v]);
    if (!hull_.build(points_)) return {};
    const double decay = std::pow(plan_.last_step / plan_.first_step, 1.0 / std::max(1, plan_.steps - 1));
    double step = plan_.first_step * solid_.diagonal();
    for (int s = 0; s < plan_.steps; ++s, step *= decay) {
      const bool may_revive = plan_.revives && s < kReviveUntil * plan_.steps;
      if (may_revive && s % kReviveEvery == kReviveEvery - 1) revive_dead_vertices();
      gather_forces(
          solid_, points_, hull_.faces(), {plan_.samples_along, 1, false, steering_}, random_,
          [](const auto&) { return false; }, forces_);
      move(step);
      if (!hull_.follow(points_)) return {};
      steer_volume(s);
    }
    PartFit fit;
    fit.volume = hull_.volume();
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (hull_.is_vertex(static_cast<int>(v))) fit.points.push_back(points_[v]);
    return fit;
  }

 private:
  void put(std::size_t vertex, const Vec3& place) {
    points_[vertex] = project_into_cell(place, cell_, centre_, margin_of(vertex, solid_.diagonal()));
  }

  void move(double step) {
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (forces_.share[v] <= 0) continue;
      velocity_[v] = kMomentum * velocity_[v] + ((1 - kMomentum) / forces_.share[v]) * forces_.force[v];
      put(v, points_[v] + step * velocity_[v]);
    }
  }

  void steer_volume(int step) {
    if (plan_.volume <= 0 || step < 0.2 * plan_.steps) return;
    steering_ += std::clamp(kVolumeGain * (hull_.volume() / plan_.volume - 1), -0.05, 0.05);
    steering_ = std::clamp(steering_, -kLargestSteering, kLargestSteering);
  }

  /// Whether all corners lie on one cut plane, as near as the fit keeps them to it.
  bool is_on_cut(const std::array<int, 3>& face) const {
    return std::any_of(cell_.begin(), cell_.end(), [&](const Plane& plane) {
      return std::all_of(face.begin(), face.end(),
                         [&](int v) { return plane.signed_distance(at(v)) > -4 * kCellMargin * solid_.diagonal(); });
    });
  }

  /// Vertices that fell inside the hull, and those in the midst of a cut face, which shape nothing either.
  void find_dead_vertices() {
    std::vector<char> is_useful(points_.size(), 0);
    for (const auto& face : hull_.faces())
      if (!is_on_cut(face))
        for (const int v : face) is_useful[static_cast<std::size_t>(v)] = 1;
    dead_.clear();
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (!is_useful[v]) dead_.push_back(v);
  }

  /// Puts dead vertices on the faces with most rock outside, half-way up.
  void revive_dead_vertices() {
    find_dead_vertices();
    if (dead_.empty()) return;
    const std::vector<Vec3> places = bump_places(solid_, points_, hull_.faces(), cell_, kCellMargin * solid_.diagonal(),
                                                 dead_.size(), [&](const auto& face) { return is_on_cut(face); });
    for (std::size_t k = 0; k < places.size(); ++k) {
      put(dead_[k], places[k]);
      velocity_[dead_[k]] = {};
    }
    hull_.build(points_);
  }

  const Vec3& at(int vertex) const { return points_[static_cast<std::size_t>(vertex)]; }

  const Solid& solid_;
  const std::vector<Plane>& cell_;
  const Vec3 centre_;
  const FitPlan& plan_;
  Random random_;
  SmallHull hull_;
  std::vector<Vec3> points_, velocity_;
  VertexForces forces_;
  std::vector<std::size_t> dead_;
  double steering_ = 0;  // multiplier of the volume: positive pushes inward
};

}  // namespace

Vec3 project_into_cell(Vec3 p, const std::vector<Plane>& cell, const Vec3& centre, double margin) {
  const Vec3 given = p;
  double farthest = 0;
  for (int pass = 0; pass < kProjectionPasses; ++pass) {
    bool is_inside = true;
    for (const Plane& plane : cell)
      if (const double excess = plane.signed_distance(p) + margin; excess > 1e-3 * margin) {
        p -= excess * plane.normal;
        if (pass == 0) farthest = std::max(farthest, excess);
        is_inside = false;
      }
    if (is_inside && norm(p - given) <= kLongestDetour * farthest) return p;
    if (is_inside) break;  // between planes at a small angle the way out of one leads far along the other
  }
  p = given;
  double share = 1;  // of the way from the centre: certain to end in the cell
  for (const Plane& plane : cell) {
    const double depth = -plane.signed_distance(centre) - margin, reach = dot(plane.normal, p - centre);
    if (reach > depth) share = std::min(share, std::max(0.0, depth) / reach);
  }
  return centre + share * (p - centre);
}

std::vector<Vec3> start_points(const Solid& solid, const RegionMoments& region, const std::vector<Plane>& cell,
                               const FitPlan& plan) {
  Random random(sub_seed(plan.seed, 7));
  const Frame frame = random_frame(random);
  const double march = solid.cell();
  std::vector<Vec3> points;
  for (int i = 0; i < plan.vertices; ++i) {
    const Vec3 direction = frame(spread_direction(i, plan.vertices));
    const Vec3 reach =
        direction.x * region.semi_axes[0] + direction.y * region.semi_axes[1] + direction.z * region.semi_axes[2];
    const double length = norm(reach);
    if (length == 0) continue;
    const auto filled = [&](double t) { return solid.occupancy(region.centroid + t * reach) > 0.5; };
    double t = 1;
    if (filled(t))
      while (t < 1.6 && filled(t)) t += march / length;
    else
      while (t > 0.5 && !filled(t)) t -= march / length;
    points.push_back(
        project_into_cell(region.centroid + t * reach, cell, region.centroid, kCellMargin * solid.diagonal()));
  }
  return points;
}

PartFit fit_part(const Solid& solid, const std::vector<Plane>& cell, const Vec3& centre, std::vector<Vec3> points,
                 const FitPlan& plan) {
  return Fitter(solid, cell, centre, plan).run(std::move(points));
}

}  // namespace decomposition
