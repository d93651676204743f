// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/floor_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kTrials = 600;  // a plane of 15 % of the points is drawn twice
constexpr std::size_t kScoredPoints = 2500;
constexpr double kFirstBand = 0.004;   // half thickness / diagonal, before the noise is known
constexpr double kBandDeviations = 5;  // of the points taken for the plane's: one of a million strays beyond
constexpr int kRefinements = 4;
constexpr double kLeastShare = 0.1;         // of the points: fewer are a facet
constexpr double kLargestOtherSide = 0.01;  // of the rest: strays below the floor
constexpr double kLeastReach = 1;           // of the plane's points about the rest's middle / that of the rest
constexpr std::size_t kLeastLeft = 50;      // points that may be a particle

struct Plane {
  Point normal{};
  double offset = 0;

  double height(const Point& point) const { return dot(normal, point) - offset; }
};

std::optional<Plane> plane_through(const Point& a, const Point& b, const Point& c) {
  const Point normal = cross(subtract(b, a), subtract(c, a));
  if (!(norm(normal) > 0)) return std::nullopt;
  Plane plane{normalized(normal), 0};
  plane.offset = dot(plane.normal, a);
  return plane;
}

/// Plane of least squares.
Plane fitted_plane(const std::vector<Point>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Point& p : points) mean += Eigen::Vector3d(p[0], p[1], p[2]);
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Point& p : points) {
    const Eigen::Vector3d arm = Eigen::Vector3d(p[0], p[1], p[2]) - mean;
    spread += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return {{normal[0], normal[1], normal[2]}, normal.dot(mean)};
}

/// Points below, in and above a band about the plane.
struct Sides {
  std::size_t below = 0, within = 0, above = 0;

  bool has_one_side() const {
    return static_cast<double>(std::min(below, above)) <= kLargestOtherSide * static_cast<double>(below + above);
  }
};

Sides sides(const std::vector<Point>& points, const Plane& plane, double band) {
  Sides count;
  for (const Point& point : points) {
    const double height = plane.height(point);
    ++(height < -band ? count.below : height > band ? count.above : count.within);
  }
  return count;
}

/// Standard deviation of the heights within the band, by their median: the feet of grains do not count.
double noise_within(const std::vector<Point>& points, const Plane& plane, double band) {
  std::vector<double> heights;
  for (const Point& point : points)
    if (const double height = std::abs(plane.height(point)); height <= band) heights.push_back(height);
  if (heights.empty()) return 0;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return 1.4826 * *middle;
}

std::optional<Plane> drawn_plane(const std::vector<Point>& points, double band) {
  RandomStream random(1);
  const auto draw = [&] {
    return points[static_cast<std::size_t>(random.uniform(0, static_cast<double>(points.size())))];
  };
  std::vector<Point> few;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kScoredPoints);
  for (std::size_t i = 0; i < points.size(); i += step) few.push_back(points[i]);
  std::optional<Plane> best;
  std::size_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Point a = draw(), b = draw(), c = draw();
    const std::optional<Plane> plane = plane_through(a, b, c);
    if (!plane) continue;
    const Sides found = sides(few, *plane, band);
    if (found.within <= most || !found.has_one_side()) continue;
    most = found.within;
    best = plane;
  }
  return best;
}

/// Largest distance along the plane from the middle of the rest, strays left out: of the rest, or of the plane.
double reach_along(const std::vector<Point>& points, const Plane& plane, const Point& middle) {
  std::vector<double> distances;
  for (const Point& point : points) {
    const Point way = subtract(point, middle);
    distances.push_back(norm(subtract(way, scaled(plane.normal, dot(way, plane.normal)))));
  }
  if (distances.empty()) return 0;
  const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), rank, distances.end());
  return *rank;
}

Point mean_point(const std::vector<Point>& points) {
  Point sum{};
  for (const Point& point : points) sum = add(sum, point);
  return scaled(sum, 1 / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
}

[[noreturn]] void refuse(const std::string& name, const std::string& finding) {
  throw catalog::InputError(name + ": " + finding +
                            "; leave --remove-plane out if the scan has no floor, or scan a wider rim of it");
}

}  // namespace

ClearedCloud without_floor(const PointCloud& cloud, const std::string& name) {
  double band = kFirstBand * bounding_diagonal(cloud.points);
  std::optional<Plane> plane = drawn_plane(cloud.points, band);
  if (!plane) refuse(name, "no plane has all other points on one side");
  ClearedCloud cleared;
  std::vector<Point> floor;
  for (int pass = 0; pass < kRefinements; ++pass) {
    floor.clear();
    for (const Point& point : cloud.points)
      if (std::abs(plane->height(point)) <= band) floor.push_back(point);
    if (floor.size() < 3) refuse(name, "no plane has all other points on one side");
    plane = fitted_plane(floor);
    cleared.noise = noise_within(cloud.points, *plane, band);
    band = kBandDeviations * cleared.noise + 1e-9 * bounding_diagonal(cloud.points);
  }
  if (const Sides found = sides(cloud.points, *plane, band); found.below > found.above)
    plane = Plane{scaled(plane->normal, -1), -plane->offset};

  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!(plane->height(cloud.points[i]) > band)) continue;
    cleared.cloud.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) cleared.cloud.normals.push_back(cloud.normals[i]);
  }
  const Sides found = sides(cloud.points, *plane, band);
  const Point middle = mean_point(cleared.cloud.points);
  if (found.above < kLeastLeft) refuse(name, "nothing stands on the plane: " + std::to_string(found.above) + " points");
  if (!found.has_one_side() ||
      static_cast<double>(found.within) < kLeastShare * static_cast<double>(cloud.points.size()) ||
      reach_along(floor, *plane, middle) < kLeastReach * reach_along(cleared.cloud.points, *plane, middle))
    refuse(name, "no plane with a tenth of the points has all others on one side and reaches past them");

  cleared.normal = plane->normal;
  cleared.offset = plane->offset;
  cleared.checks = {{"floor_points", true, static_cast<double>(found.within), "points of the floor's plane removed"},
                    {"floor_noise", true, cleared.noise, "standard deviation of the floor's points [m]"},
                    {"floor_beneath", true, static_cast<double>(found.below), "points beneath the floor removed"}};
  return cleared;
}

}  // namespace shape_pipeline
